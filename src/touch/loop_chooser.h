// LoopChooser: which loop ticks. On the servo thread a tick sees the sample of its own step, and the path
// from encoder to motor is one step long; but a tick that takes longer than the step makes the force late. So the servo
// thread ticks as long as nearly all ticks fit, and hands them to the proxy thread when too many do not.
//
// A debt decides. Each half of a servo period that a tick takes beyond the first adds kCost to it, each tick that fits
// takes one off: below one in kCost that is late it stays near zero. At kMax the ticks go to the proxy thread; there
// they must fit in half as much, and when they have paid kBack they return. While the hands of several devices are in a
// world of bodies, neither of the two ticks, but the loop of the group (hand_group.h).
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace hl {

enum class Turn : std::uint8_t { kServo, kProxy, kGroup };

/// Each loop ticks only while it is its turn; took() and give() by the loop whose turn it is. RT-safe.
class LoopChooser {
 public:
  explicit LoopChooser(std::int64_t servo_period_ns) : room_ns_(servo_period_ns / 2) {}

  Turn turn() const { return turn_.load(std::memory_order_acquire); }
  void give(Turn turn) {
    debt_ = turn == Turn::kProxy ? kBack : 0;
    turn_.store(turn, std::memory_order_release);
  }
  /// How long the tick took; the next one may be the other loop's.
  void took(std::int64_t work_ns) {
    const Turn turn = turn_.load(std::memory_order_relaxed);
    if (turn == Turn::kGroup) return;
    const bool servo = turn == Turn::kServo;
    const std::int64_t over = work_ns / (servo ? room_ns_ : room_ns_ / 2);
    debt_ = std::clamp<std::int64_t>(debt_ + (over > 0 ? std::min(over, kMax) * kCost : -1), 0, kMax);
    if (servo && debt_ == kMax) {
      give(Turn::kProxy);
    } else if (!servo && debt_ == 0) {
      give(Turn::kServo);
    }
  }

  static constexpr std::int64_t kCost = 100;  ///< one late tick in so many is no harm
  static constexpr std::int64_t kMax = 500;   ///< five late ones on end, or one of two and a half periods
  static constexpr std::int64_t kBack = 500;  ///< ticks that must fit before they return

 private:
  std::int64_t room_ns_;
  std::int64_t debt_ = 0;
  std::atomic<Turn> turn_{Turn::kServo};
};

}  // namespace hl
