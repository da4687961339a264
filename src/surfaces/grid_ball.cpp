#include "surfaces/grid_ball.h"

#include <cmath>

namespace hl {

GridMetric::GridMetric(const GridFrame& frame) : inverse(frame.axes.inverse()), origin(frame.origin) {
  const Mat3 q = frame.axes.transpose() * frame.axes;
  const double w = q(2, 2);
  for (Eigen::Index axis = 0; axis < 3; ++axis) reach[axis] = inverse.row(axis).norm();
  lift = 1 / std::sqrt(w);
  tilt = Vec2(q(0, 2), q(1, 2)) / w;
  const double a = q(0, 0) / w - tilt.x() * tilt.x(), b = q(1, 1) / w - tilt.y() * tilt.y();
  const double skew = std::abs(q(0, 1) / w - tilt.x() * tilt.y()) / std::sqrt(a * b);
  curve = (1 - skew) * Vec2(a, b);
}

GridBall::GridBall(const GridMetric& metric, const Vec3& from, const Vec3& motion, double radius)
    : metric_(metric), from_(metric.inverse * (from - metric.origin)), motion_(metric.inverse * motion) {
  setRadius(radius);
}

void GridBall::setPart(double begin, double end) {
  begin_ = begin;
  end_ = end;
  bound();
}

void GridBall::setRadius(double radius) {
  radius_ = radius;
  lift_ = metric_.lift * radius;
  bound();
}

void GridBall::bound() {
  first_ = from_ + begin_ * motion_;
  last_ = from_ + end_ * motion_;
  const Vec3 half = radius_ * metric_.reach;
  low_ = first_.cwiseMin(last_) - half;
  high_ = first_.cwiseMax(last_) + half;
}

}  // namespace hl
