// PlaneReach: where a moving ball may touch what lies between two parallel planes.
//
// What is within a distance e of a plane, and within the radius r of a centre that is d from the plane, is within
// sqrt(r^2 - (d - e)^2) of the foot of the centre on the plane: of a ball that just touches, a disc that is much
// smaller than the ball.
#pragma once

#include <algorithm>
#include <cmath>

#include "surfaces/grid_ball.h"

namespace hl {

class PlaneReach {
 public:
  /// Of the places x, in the coordinates of the ball, with |value + normal . (x - at)| <= rest.
  PlaneReach(const GridBall& ball, const Vec3& at, double value, const Vec3& normal, double rest)
      : low_(ball.low()), high_(ball.high()) {
    const Mat3& inverse = ball.metric().inverse;
    const Vec3 per_metre = inverse.transpose() * normal;
    const double slope = per_metre.norm();
    if (!(slope > 0) || !std::isfinite(rest)) return;
    const Vec3 unit = per_metre / slope;
    const double from = (value + normal.dot(ball.first() - at)) / slope,
                 to = (value + normal.dot(ball.last() - at)) / slope;
    const double nearest = (from > 0) != (to > 0) ? 0 : std::min(std::abs(from), std::abs(to));
    const double half = rest / slope, depth = std::max(0.0, nearest - half);
    const double square = ball.radius() * ball.radius() * (1 + kRounding) - depth * depth;
    misses_ = square < 0;
    if (misses_) return;
    const double disc = std::sqrt(square) + kRounding * ball.radius();
    const Vec3 first = ball.first() - inverse * (from * unit);
    const Vec3 last = ball.last() - inverse * (to * unit);
    Vec3 reach;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vec3 row = inverse.row(axis);
      const double along = row.dot(unit);
      reach[axis] = disc * std::sqrt(std::max(0.0, row.squaredNorm() - along * along)) + half * std::abs(along) +
                    kRounding * disc * row.norm();
    }
    low_ = (first.cwiseMin(last) - reach).cwiseMax(ball.low());
    high_ = (first.cwiseMax(last) + reach).cwiseMin(ball.high());
  }

  bool misses() const { return misses_; }
  /// The coordinates of the ball.
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }

 private:
  static constexpr double kRounding = 1e-9;

  Vec3 low_, high_;
  bool misses_ = false;
};

}  // namespace hl
