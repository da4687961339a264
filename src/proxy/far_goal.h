// Far goal: a goal much farther away than the scene is large. Its distance would drown the scene in rounding, so steps
// aim at a place as far as FarGoal allows, in the same direction from where the proxy is. That is sound:
//   * Whether the proxy rests depends on the direction alone: goal - x is a sum of normals, or it is not.
//   * A step s toward the nearer goal g' = part * g above planes that the proxy itself is above has s . (g' - s) >= 0,
//     so |g - s|^2 <= |g|^2 - (2 / part - 1) |s|^2: it comes nearer to the goal itself too.
// In the open, where nothing holds the proxy, there is nothing to meet but within a ball about the scene.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// RT-safe.
class FarGoal {
 public:
  /// `farthest_m`: of a goal, from the proxy; the ball has this diameter. The scene lies well within it.
  explicit FarGoal(double farthest_m) : farthest_m_(farthest_m) {}

  /// The part 0..1 of the way to a goal `gap` away that steps aim at.
  double part(const Vec3& gap) const {
    const double length = gap.norm();
    return length > farthest_m_ ? farthest_m_ / length : 1;
  }
  Vec3 shortened(const Vec3& gap) const {
    const double aim = part(gap);
    return aim == 1 ? gap : Vec3(aim * gap);
  }
  double shortened_m(const Vec3& gap) const { return std::min(gap.norm(), farthest_m_); }

  /// The part of a straight way within the ball, from `enter` to `leave`; nothing of it where leave < enter.
  struct Within {
    double enter = 0, leave = 1;
  };
  Within within(const Vec3& from, const Vec3& way) const;

 private:
  double farthest_m_;
};

}  // namespace hl
