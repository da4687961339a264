// In the place of oneTBB's header: see blocked_range.h.
#pragma once

#include <algorithm>

namespace oneapi::tbb {

template <typename Iterator, typename Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
  std::sort(begin, end, less);
}

}  // namespace oneapi::tbb
