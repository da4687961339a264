// Seconds of settings as durations of the clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace hl {

inline std::chrono::nanoseconds durationOf(double seconds) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * seconds));
}

}  // namespace hl
