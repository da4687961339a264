// Watchdog: notices from outside when the servo stands still. It counts its own looks, not the clock's time: when the
// whole machine has paused, watchdog and servo alike, that is no stall.
#pragma once

#include <cstdint>

namespace hl {

/// Owned by the thread that watches. RT-safe.
class Watchdog {
 public:
  /// `looks`: how many in a row without a step of the servo are a stall, >= 1.
  explicit Watchdog(std::uint32_t looks) : looks_(looks) {}

  /// One look at how many steps the servo has made since it began. True once for each stall, when it is found.
  bool look(std::uint64_t steps);

 private:
  std::uint32_t looks_;
  std::uint32_t unmoved_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace hl
