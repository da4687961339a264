// TargetBlend: a scene that changes at once under the finger must not push at once. When objects appear, go or become
// other ones, the pull of the scene before goes on, as far as it was another one for the same finger, and fades out.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// What still fades: a pull, m, device frame, of which the part left_s / duration_s is felt.
struct FadingPull {
  Vec3 offset = Vec3::Zero();  ///< when it was begun
  double duration_s = 0, left_s = 0;
};

/// Of pulls: s (proxy - finger), m, device frame. Owned by the proxy loop. RT-safe.
class TargetBlend {
 public:
  TargetBlend() = default;
  explicit TargetBlend(const FadingPull& fading) : fading_(fading) {}
  const FadingPull& fading() const { return fading_; }

  /// From now on the same finger is pulled by `change` less than before; to be felt only over `duration_s`, and no
  /// sooner than what still fades would have gone.
  void add(const Vec3& change, double duration_s) {
    if (!(change.norm() > kUnfelt_m)) return;
    fading_.offset = offset() + change;
    fading_.duration_s = fading_.left_s = std::max(fading_.left_s, duration_s);
  }
  /// What is to be added to the pull now; `period_s` after the last call.
  Vec3 step(double period_s) {
    fading_.left_s = std::max(0.0, fading_.left_s - period_s);
    return offset();
  }
  bool active() const { return fading_.left_s > 0; }

 private:
  // 0.2 mN at 2000 N/m: less than a motor's smallest step.
  static constexpr double kUnfelt_m = 1e-7;

  Vec3 offset() const {
    return active() ? Vec3(fading_.left_s / fading_.duration_s * fading_.offset) : Vec3(Vec3::Zero());
  }

  FadingPull fading_;
};

}  // namespace hl
