// BallOverPlane: whether a moving ball is clear of a piece of a plane, or of a slab between two, in grid coordinates.
// HeightIndex has the derivation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "surfaces/grid_ball.h"

namespace hl {

/// The two paraboloids around a ball, one below and one above. They touch it where its slope is the given one, and hold
/// for planes of any slope.
class BallBowls {
 public:
  BallBowls(const GridBall& ball, double slope_column, double slope_row) {
    const GridMetric& metric = ball.metric();
    const double column = slope_column + metric.tilt.x(), row = slope_row + metric.tilt.y();
    const double k = ball.lift() / std::sqrt(1 + column * column / metric.curve.x() + row * row / metric.curve.y());
    depth_ = 0.5 * (k + ball.lift() * ball.lift() / k);
    vertex_ = {k / metric.curve.x(), k / metric.curve.y()};
    square_ = {0.5 / vertex_[0], 0.5 / vertex_[1]};
  }

  double depth() const { return depth_; }
  /// Least value of square d^2 - slope d over d from low to high.
  double least(std::size_t axis, double slope, double low, double high) const {
    const double d = std::clamp(slope * vertex_[axis], low, high);
    return (square_[axis] * d - slope) * d;
  }

 private:
  double depth_;
  std::array<double, 2> vertex_, square_;
};

/// Slopes for each grid step. Heights over it are from the plane through height 0 at this place.
struct GridPlane {
  double column, row, slope_column, slope_row;
};

class BallOverPlane {
 public:
  BallOverPlane(const GridBall& ball, const BallBowls& bowls, const GridPlane& plane)
      : ball_(ball),
        bowls_(bowls),
        plane_(plane),
        slope_{plane.slope_column + ball.metric().tilt.x(), plane.slope_row + ball.metric().tilt.y()} {
    const double first = over(ball.first()), last = over(ball.last());
    low_ = std::min(first, last);
    high_ = std::max(first, last);
    depth_ = (1 + kRounding) * bowls.depth() + kRounding * size_;
  }

  /// A height of the grid over the plane.
  double rest(double column, double row, double height) const {
    return height - plane_.slope_column * (column - plane_.column) - plane_.slope_row * (row - plane_.row);
  }
  /// Whether the centre is above this height over the plane, in the middle of its way.
  bool isAbove(double height) const { return low_ + high_ > 2 * height; }

  // For what is below the ball `up` is 1; for what is above it -1, and everything is upside down.

  /// The least height over the plane of the ball's lower bowl, but for the terms of columns and rows.
  double clear(double up) const { return (up > 0 ? low_ : -high_) - depth_; }
  /// The least of the term of columns (axis 0) or rows, over the places from first to last.
  double least(double up, std::size_t axis, double first, double last) const {
    const auto of = static_cast<Eigen::Index>(axis);
    const double west = std::min(ball_.first()[of], ball_.last()[of]),
                 east = std::max(ball_.first()[of], ball_.last()[of]);
    return bowls_.least(axis, up * slope_[axis], first - east, last - west);
  }

  /// Whether the ball touches nothing between the planes of height low and high, over these columns and rows.
  bool clears(double low, double high, const std::array<double, 2>& columns, const std::array<double, 2>& rows) const {
    const double up = isAbove(0.5 * low + 0.5 * high) ? 1 : -1;
    const double bowl = least(up, 0, columns[0], columns[1]) + least(up, 1, rows[0], rows[1]);
    const double rounding = kRounding * (std::abs(low) + std::abs(high));
    return (up > 0 ? high : -low) + rounding < clear(up) + bowl;
  }

 private:
  // A few hundred times what rounding does to sums of such sizes.
  static constexpr double kRounding = 1e-12;

  double over(const Vec3& centre) {
    const double across = plane_.slope_column * (centre.x() - plane_.column);
    const double down = plane_.slope_row * (centre.y() - plane_.row);
    size_ = std::max(size_, std::abs(centre.z()) + std::abs(across) + std::abs(down));
    return centre.z() - across - down;
  }

  const GridBall& ball_;
  const BallBowls bowls_;
  const GridPlane plane_;
  const std::array<double, 2> slope_;
  double low_, high_, size_ = 0, depth_;
};

}  // namespace hl
