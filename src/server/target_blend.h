// TargetBlend: a scene that changes at once under the finger must not push at once. When objects appear, go or jump,
// the target begins where it was and comes over to the new one in a short time.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// Device frame. Owned by the proxy loop. RT-safe.
class TargetBlend {
 public:
  /// 60 ms: at 1800 N/m and the device's 8.5 N that is 140 N/s, as when a person presses.
  static constexpr double kDuration_s = 0.060;

  /// The target, `before` until now, is `wanted` from now on, but not at once.
  void begin(const Vec3& before, const Vec3& wanted) {
    offset_ = before - wanted;
    left_s_ = kDuration_s;
  }
  /// What the servo is told to pull to; `period_s` after the last call.
  Vec3 step(const Vec3& wanted, double period_s) {
    left_s_ = std::max(0.0, left_s_ - period_s);
    last_ = wanted + (left_s_ / kDuration_s) * offset_;
    return last_;
  }
  bool active() const { return left_s_ > 0; }
  const Vec3& last() const { return last_; }

 private:
  Vec3 last_ = Vec3::Zero();
  Vec3 offset_ = Vec3::Zero();
  double left_s_ = 0;
};

}  // namespace hl
