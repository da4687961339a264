// In the place of oneTBB's header: see blocked_range.h.
#pragma once

namespace oneapi::tbb {

template <typename... Bodies>
void parallel_invoke(const Bodies&... bodies) {
  (bodies(), ...);
}

}  // namespace oneapi::tbb
