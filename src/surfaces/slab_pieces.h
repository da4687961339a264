// SlabPieces: which of many pieces of a surface a moving ball may touch, each in a box of one size and between two
// planes of one direction.
//
// What is within a distance e of a plane, and within the radius r of a centre that is d from the plane, is within
// sqrt(r^2 - (d - e)^2) of the foot of the centre on the plane: of a ball that just touches, in a disc that is much
// smaller than the ball.
#pragma once

#include <algorithm>
#include <cmath>

#include "surfaces/grid_ball.h"

namespace hl {

/// Of the part of the ball's way that counts when this is made. Pieces are given in the coordinates of the ball.
class SlabPieces {
 public:
  /// `side`: of the cubes.
  SlabPieces(const GridBall& ball, const GridFrame& frame, double side)
      : axes_(frame.axes),
        inverse_(ball.metric().inverse),
        first_(ball.first()),
        way_m_(axes_ * (ball.last() - ball.first())),
        square_(ball.radius() * ball.radius()) {
    double longest = 0;
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(-1, 1, 1), Vec3(1, -1, 1), Vec3(1, 1, -1)})
      longest = std::max(longest, (axes_ * corner).squaredNorm());
    diagonal_m_ = 0.5 * side * std::sqrt(longest) + kRounding * ball.radius();
  }

  /// Whether the ball may touch a piece in the cube about `middle`: of the places x with
  /// |value + normal . (x - middle)| <= rest.
  bool touched(const Vec3& middle, double value, const Vec3& normal, double rest) const {
    const Vec3 per_metre = inverse_.transpose() * normal, out = axes_ * (first_ - middle);
    const double slope_square = per_metre.squaredNorm();
    if (!(slope_square > 0) || !std::isfinite(rest)) return true;
    const double over = per_metre.dot(out), from = value + over, rise = per_metre.dot(way_m_), to = from + rise;
    const double nearest = (from > 0) != (to > 0) ? 0 : std::min(std::abs(from), std::abs(to));
    const double above = std::max(0.0, nearest * (1 - kRounding) - rest);
    if (above * above > square_ * slope_square * (1 + kRounding)) return false;
    const double per_square = 1 / slope_square;
    const double left = std::max(0.0, square_ * (1 + kRounding) - above * above * per_square);
    const Vec3 across = out - over * per_square * per_metre, flat = way_m_ - rise * per_square * per_metre;
    const double square = flat.squaredNorm();
    const double part = square > 0 ? std::clamp(-across.dot(flat) / square, 0.0, 1.0) : 0;
    const double reach = (1 + kRounding) * (std::sqrt(left) + diagonal_m_);
    return (across + part * flat).squaredNorm() <= reach * reach;
  }

 private:
  static constexpr double kRounding = 1e-9;  // of sizes

  const Mat3 &axes_, &inverse_;
  const Vec3 first_, way_m_;
  const double square_;
  double diagonal_m_ = 0;
};

}  // namespace hl
