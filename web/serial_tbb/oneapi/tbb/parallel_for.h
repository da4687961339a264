// In the place of oneTBB's header: see blocked_range.h.
#pragma once

#include <cstddef>

#include "oneapi/tbb/blocked_range.h"

namespace oneapi::tbb {

template <typename Value, typename Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
  if (range.size() > 0) body(range);
}

template <typename Body>
void parallel_for(std::size_t begin, std::size_t end, const Body& body) {
  for (std::size_t i = begin; i < end; ++i) body(i);
}

}  // namespace oneapi::tbb
