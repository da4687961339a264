// TargetBlend: a scene that changes at once under the finger must not push at once. When objects appear, go or become
// other ones, the pull of the scene before goes on, as far as it was another one for the same finger, and fades out.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// Of pulls: s (proxy - finger), m, device frame. Owned by the proxy loop. RT-safe.
class TargetBlend {
 public:
  /// From now on the same finger is pulled by `change` less than before; to be felt only over `duration_s`, and no
  /// sooner than what still fades would have gone.
  void add(const Vec3& change, double duration_s) {
    if (!(change.norm() > kUnfelt_m)) return;
    offset_ = offset() + change;
    duration_s_ = left_s_ = std::max(left_s_, duration_s);
  }
  /// What is to be added to the pull now; `period_s` after the last call.
  Vec3 step(double period_s) {
    left_s_ = std::max(0.0, left_s_ - period_s);
    return offset();
  }
  bool active() const { return left_s_ > 0; }

 private:
  // 0.2 mN at 2000 N/m: less than a motor's smallest step.
  static constexpr double kUnfelt_m = 1e-7;

  Vec3 offset() const { return left_s_ > 0 ? Vec3(left_s_ / duration_s_ * offset_) : Vec3(Vec3::Zero()); }

  Vec3 offset_ = Vec3::Zero();  // when it was begun
  double duration_s_ = 0, left_s_ = 0;
};

}  // namespace hl
