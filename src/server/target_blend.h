// TargetBlend: a scene that changes at once under the finger must not push at once. When objects appear, go, jump or
// bend, the target begins where it was and comes over to the new one in a short time.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// Device frame. Owned by the proxy loop. RT-safe.
class TargetBlend {
 public:
  /// The target, `before` until now, is `wanted` from now on, but only in `duration_s`; no sooner than a blend that
  /// still goes on would have ended.
  void begin(const Vec3& before, const Vec3& wanted, double duration_s) {
    offset_ = before - wanted;
    duration_s_ = left_s_ = std::max(left_s_, duration_s);
  }
  /// What the servo is told to pull to; `period_s` after the last call.
  Vec3 step(const Vec3& wanted, double period_s) {
    left_s_ = std::max(0.0, left_s_ - period_s);
    last_ = wanted;
    if (left_s_ > 0) last_ += (left_s_ / duration_s_) * offset_;
    return last_;
  }
  bool active() const { return left_s_ > 0; }
  const Vec3& last() const { return last_; }

 private:
  Vec3 last_ = Vec3::Zero();
  Vec3 offset_ = Vec3::Zero();
  double duration_s_ = 0, left_s_ = 0;
};

}  // namespace hl
