// GridBall: a ball on a straight way, in the coordinates of a grid, where it is an ellipsoid.
//
// With axes M, Q = M^T M, and the ball's centre c(t), a point g is in the ball of radius r when
//   (g - c)^T Q (g - c) <= r^2.
// Solved for the third coordinate w, with d = (g - c) of the first two, its lower side is
//   w = c_w - b.d - sqrt(rho^2 - d^T A d),   rho = r / |M_w|,  b = Q_w / Q_ww,  A = (Q_ww Q_uv - Q_w Q_w^T) / Q_ww^2.
#pragma once

#include "base/vec.h"
#include "surfaces/grid_frame.h"

namespace hl {

/// m per step along each axis, so that no step is longer than it is.
Vec3 shortestStep(const GridFrame& frame);

/// From a frame, once: what all its balls have in common.
struct GridMetric {
  explicit GridMetric(const GridFrame& frame);

  Mat3 inverse;  ///< grid steps per metre
  Vec3 origin;   ///< m
  Vec3 reach;    ///< grid steps: half the sides of the bounding box of a ball of 1 m
  double lift;   ///< units of the samples: rho of a ball of 1 m
  Vec2 tilt;     ///< b
  Vec2 curve;    ///< a diagonal matrix not above A, so that d^T A d >= curve . d^2; above 0
  Mat3 slopes;   ///< per m^2: n . slopes n is the square of the slope in metres of a function with the gradient n
};

/// The part of the way from `begin` to `end` (fractions of the motion) counts.
class GridBall {
 public:
  /// Object frame, m.
  GridBall(const GridMetric& metric, const Vec3& from, const Vec3& motion, double radius);

  void setPart(double begin, double end);
  void setRadius(double radius);
  double begin() const { return begin_; }
  double end() const { return end_; }
  double radius() const { return radius_; }  ///< m

  // In grid coordinates: the centre at both ends of the part, and bounds of the moving ball.
  const Vec3& first() const { return first_; }
  const Vec3& last() const { return last_; }
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  double lift() const { return lift_; }  ///< rho
  const GridMetric& metric() const { return metric_; }

 private:
  void bound();

  const GridMetric& metric_;
  Vec3 from_, motion_;
  double radius_, begin_ = 0, end_ = 1, lift_ = 0;
  Vec3 first_, last_, low_, high_;
};

}  // namespace hl
