#include "surfaces/grid_ball.h"

#include <algorithm>
#include <cmath>

namespace hl {

// Q = axes^T axes is not below its diagonal times 1 - s, s the largest sum of a row of the others, once the diagonal is
// 1 (Gershgorin).
Vec3 shortestStep(const GridFrame& frame) {
  const Mat3 q = frame.axes.transpose() * frame.axes;
  const Vec3 length = q.diagonal().cwiseSqrt();
  double skew = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    double row = 0;
    for (Eigen::Index j = 0; j < 3; ++j) row += i == j ? 0 : std::abs(q(i, j)) / (length[i] * length[j]);
    skew = std::max(skew, row);
  }
  return std::sqrt(std::max(0.0, 1 - skew)) * length;
}

GridMetric::GridMetric(const GridFrame& frame) : inverse(frame.axes.inverse()), origin(frame.origin) {
  const Mat3 q = frame.axes.transpose() * frame.axes;
  const double w = q(2, 2);
  for (Eigen::Index axis = 0; axis < 3; ++axis) reach[axis] = inverse.row(axis).norm();
  lift = 1 / std::sqrt(w);
  tilt = Vec2(q(0, 2), q(1, 2)) / w;
  const double a = q(0, 0) / w - tilt.x() * tilt.x(), b = q(1, 1) / w - tilt.y() * tilt.y();
  const double skew = std::abs(q(0, 1) / w - tilt.x() * tilt.y()) / std::sqrt(a * b);
  curve = (1 - skew) * Vec2(a, b);
  slopes = inverse * inverse.transpose();
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
