// Far goal: a goal much farther away than the scene is large. Using it directly would make rounding errors larger than
// the scene, so steps aim at a nearer point in the same direction from the proxy. This is sound:
//   * Whether the proxy rests depends on the direction only: goal - x is a non-negative sum of normals, or it is not.
//   * A step s toward the nearer goal g' = part * g, above planes that the proxy itself satisfies, has
//     s . (g' - s) >= 0, so |g - s|^2 <= |g|^2 - (2 / part - 1) |s|^2: it also comes nearer to the goal itself.
// A proxy without contacts can meet primitives only within a ball about the scene.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// RT-safe.
class FarGoal {
 public:
  /// `farthest_m`: maximum distance of a goal from the proxy, and diameter of the ball about the origin. The scene lies
  /// well within the ball.
  explicit FarGoal(double farthest_m) : farthest_m_(farthest_m) {}

  /// The fraction 0..1 of the vector `gap` to the goal at which steps aim.
  double part(const Vec3& gap) const {
    const double length = gap.norm();
    return length > farthest_m_ ? farthest_m_ / length : 1;
  }
  Vec3 shortened(const Vec3& gap) const {
    const double aim = part(gap);
    return aim == 1 ? gap : Vec3(aim * gap);
  }
  double shortened_m(const Vec3& gap) const { return std::min(gap.norm(), farthest_m_); }

  /// The part of a straight way that lies within the ball, from fraction `enter` to `leave`; empty if leave < enter.
  struct Within {
    double enter = 0, leave = 1;
  };
  Within within(const Vec3& from, const Vec3& way) const;

 private:
  double farthest_m_;
};

}  // namespace hl
