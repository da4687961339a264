// The monotonic clock of the loops, in nanoseconds.
#pragma once

#include <time.h>

#include <cstdint>

namespace hl {

/// CLOCK_MONOTONIC now; vDSO, no system call on Linux. RT-safe.
inline std::int64_t monotonicNow_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace hl
