// StartPauses: how long to wait before a program that has ended by itself is started again: after each end twice as
// long, so that one that cannot live costs nothing and fills no log.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>

#include "base/clock.h"

namespace hl {

class StartPauses {
 public:
  /// Waits for the next pause, while `goes_on`, which is asked fifty times a second.
  template <typename GoesOn>
  void wait(GoesOn&& goes_on) {
    const std::int64_t until_ns = monotonicNow_ns() + std::exchange(next_ns_, std::min(2 * next_ns_, kLongest_ns));
    while (goes_on() && monotonicNow_ns() < until_ns) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

 private:
  static constexpr std::int64_t kFirst_ns = 500'000'000, kLongest_ns = 60'000'000'000;

  std::int64_t next_ns_ = kFirst_ns;
};

}  // namespace hl
