// BallBoxes: whether a moving ball may meet boxes that lie along the axes of a grid.
//
// A box is left out if it does not meet the bounds of the ball, whose centre moves along a segment (a slab test); or if
// its middle is farther from the segment than the radius and half of its diagonal. That distance is measured along the
// axes of the grid, each with a scale that makes nothing longer.
#pragma once

#include <algorithm>
#include <cmath>

#include "surfaces/grid_ball.h"

namespace hl {

class BallBoxes {
 public:
  /// `scale`: shortestStep() of the grid's frame. The ball may change between calls.
  BallBoxes(const GridBall& ball, const Vec3& scale) : ball_(ball), scale_(scale) {}

  /// Grid coordinates; `half`: half of the box's sides.
  bool meets(const Vec3& middle, const Vec3& half) const {
    return throughBounds(middle, half) && isNear(middle, half.cwiseProduct(scale_).norm());
  }
  /// Whether a ball of `extra_m` around this place may be touched.
  bool isNear(const Vec3& place, double extra_m) const {
    const Vec3 along = scale_.cwiseProduct(ball_.last() - ball_.first());
    const Vec3 from = scale_.cwiseProduct(place - ball_.first());
    const double square = along.squaredNorm();
    const double part = square > 0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0;
    const double reach = (1 + kRounding) * (ball_.radius() + extra_m);
    return (from - part * along).squaredNorm() <= reach * reach;
  }

 private:
  static constexpr double kRounding = 1e-9;  // of sizes, and of a way

  bool throughBounds(const Vec3& middle, const Vec3& box) const {
    const Vec3 way = ball_.last() - ball_.first();
    const Vec3 half = 0.5 * (ball_.high() - ball_.low() - way.cwiseAbs()) + box;
    double begin = 0, end = 1;  // of the way, while the middle is within `half` of the centre
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double from = middle[axis] - ball_.first()[axis];
      if (way[axis] == 0) {
        if (std::abs(from) > half[axis]) return false;
        continue;
      }
      const double one = (from - half[axis]) / way[axis], other = (from + half[axis]) / way[axis];
      begin = std::max(begin, std::min(one, other) - kRounding);
      end = std::min(end, std::max(one, other) + kRounding);
    }
    return begin <= end;
  }

  const GridBall& ball_;
  const Vec3& scale_;
};

}  // namespace hl
