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

/// Nanoseconds in seconds. RT-safe.
inline double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

/// a - b and a + b for times that a broken clock, device or file may have given: they wrap around. RT-safe.
inline std::int64_t wrappedDifference_ns(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}
inline std::int64_t wrappedSum_ns(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

}  // namespace hl
