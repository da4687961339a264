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
        slopes_(ball.metric().slopes),
        first_(ball.first()),
        way_(ball.last() - ball.first()),
        way_m_(axes_ * way_),
        way_square_(way_m_.squaredNorm()),
        per_way_square_(way_square_ > 0 ? 1 / way_square_ : 0),
        radius_((1 + kRounding) * ball.radius()),
        begin_(ball.begin()),
        length_(ball.end() - ball.begin()) {
    double longest = 0;
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(-1, 1, 1), Vec3(1, -1, 1), Vec3(1, 1, -1)})
      longest = std::max(longest, (axes_ * corner).squaredNorm());
    diagonal_m_ = 0.5 * side * std::sqrt(longest) + kRounding * ball.radius();
  }

  /// Whether the ball may touch the ball around a cube about `middle`.
  bool mayTouch(const Vec3& middle) const {
    const Vec3 out = axes_ * (first_ - middle);
    const double along = out.dot(way_m_), part = along < 0 ? std::min(1.0, -along * per_way_square_) : 0;
    const double reach = (1 + kRounding) * (radius_ + diagonal_m_);
    return (out + part * way_m_).squaredNorm() <= reach * reach;
  }

  /// Whether the ball may touch a piece in the cube about `middle`: of the places x with
  /// |value + normal . (x - middle)| <= rest. Then `order` becomes at least a bound of when, as EqualBoxes has it.
  bool touched(const Vec3& middle, double value, const Vec3& normal, double rest, double& order) const {
    const double slope_square = normal.dot(slopes_ * normal);
    if (!(slope_square > 0) || !std::isfinite(rest)) return true;
    const Vec3 to = first_ - middle, out = axes_ * to;
    const double over = normal.dot(to), rise = normal.dot(way_), from = value + over, end = from + rise;
    const double nearest = (from > 0) != (end > 0) ? 0 : std::min(std::abs(from), std::abs(end));
    const double above = std::max(0.0, nearest * (1 - kRounding) - rest), per_square = 1 / slope_square;
    const double left = radius_ * radius_ - above * above * per_square;
    if (left < 0) return false;
    // The square of the distance from the middle across the normal is a + 2 b t + c t^2 at the part t of the way.
    const double a = out.squaredNorm() - over * over * per_square, b = out.dot(way_m_) - over * rise * per_square,
                 c = way_square_ - rise * rise * per_square;
    const double part = c > 0 ? std::clamp(-b / c, 0.0, 1.0) : 0;
    const double across = a + part * (2 * b + part * c), reach = (1 + kRounding) * (std::sqrt(left) + diagonal_m_);
    if (across > reach * reach + kCancelled * (out.squaredNorm() + way_square_)) return false;
    order = std::max(order, way_square_ > 0 ? soonest(from, rise, rest + radius_ * std::sqrt(slope_square), normal)
                                            : distance(above * above * per_square, across));
    return true;
  }

 private:
  static constexpr double kRounding = 1e-9;    // of sizes, and of a way
  static constexpr double kCancelled = 1e-14;  // of the terms of a sum

  // When the centre comes within `most` of value 0: before that the ball does not reach the slab.
  double soonest(double from, double rise, double most, const Vec3& normal) const {
    const double before = std::abs(from) * (1 - kRounding) - most;
    if (before <= 0) return begin_;
    const double speed = std::abs(rise) + kCancelled * normal.cwiseAbs().dot(way_.cwiseAbs());
    return begin_ + std::max(0.0, before / speed - kRounding) * length_;
  }
  // From the centre to the piece, at least.
  double distance(double above_square, double across_square) const {
    const double across = std::max(0.0, std::sqrt(std::max(0.0, across_square)) - diagonal_m_);
    return (1 - kRounding) * std::sqrt(above_square + across * across);
  }

  const Mat3 &axes_, &slopes_;
  const Vec3 first_, way_, way_m_;
  const double way_square_, per_way_square_, radius_, begin_, length_;
  double diagonal_m_ = 0;
};

}  // namespace hl
