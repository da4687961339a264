// The exponential of a twist (w, v), |w| = q, with the cross-product matrix W of w:
//
//   exp = (I + A W + B W^2,  V v),   V = I + B W + C W^2,
//   A = sin q / q,  B = (1 - cos q) / q^2,  C = (q - sin q) / q^3
//
// At a fraction s in 0..1 of the motion the rotation is exp(s w) and the translation s V(s w) v.
#include "scene/motion.h"

#include <algorithm>
#include <cmath>

#include "base/plain_math.h"
#include "base/turn.h"

namespace hl {

namespace {

// Below this angle the closed forms of B and C lose digits by cancellation; two terms of the series are then exact to
// 1e-18.
constexpr double kSeries_rad = 1e-2;

struct Coefficients {
  double a, b, c;
};

Coefficients coefficientsOf(double angle) {
  const double q2 = angle * angle;
  if (angle < kSeries_rad) {
    return {1 - q2 / 6 * (1 - q2 / 20 * (1 - q2 / 42)), 0.5 - q2 / 24 * (1 - q2 / 30 * (1 - q2 / 56)),
            1.0 / 6 - q2 / 120 * (1 - q2 / 42 * (1 - q2 / 72))};
  }
  return {plain::sin(angle) / angle, (1 - plain::cos(angle)) / q2, (angle - plain::sin(angle)) / (q2 * angle)};
}

Mat3 crossMatrix(const Vec3& w) {
  Mat3 m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

Mat3 slideMatrix(const Vec3& turn) {
  const Coefficients k = coefficientsOf(turn.norm());
  const Mat3 w = crossMatrix(turn);
  return Mat3::Identity() + k.b * w + k.c * w * w;
}

void addSphere(Box& box, const Vec3& centre, double radius) {
  box.extend(centre - Vec3::Constant(radius));
  box.extend(centre + Vec3::Constant(radius));
}

// Bounds of the motion. The bounding sphere of the box moves; its centre is never farther from either end point than
// the end points are from each other, as a turn is at most half a circle and the axis of a screw is straight.
void addWay(Box& reach, const Box& object, const Screw& way) {
  const Vec3 begin = way.from().toWorld(object.centre());
  const Vec3 end = way.to().toWorld(object.centre());
  const double radius = 0.5 * object.size().norm() + (way.angle() > 0 ? (end - begin).norm() : 0.0);
  addSphere(reach, begin, radius);
  addSphere(reach, end, radius);
}

}  // namespace

Screw::Screw(const Pose& from, const Pose& to, std::int64_t begin_ns, std::int64_t end_ns)
    : from_(from), to_(to), begin_ns_(begin_ns), end_ns_(end_ns), moves_(!(from == to)) {
  if (!moves_) return;
  const Mat3 relative = to.rotation * from.rotation.transpose();
  turn_ = rotationVector(Eigen::Quaterniond(relative));
  slide_ = slideMatrix(turn_).inverse() * (to.origin - relative * from.origin);
}

Pose Screw::at(std::int64_t time_ns) const {
  if (!moves_ || time_ns >= end_ns_) return to_;
  if (time_ns <= begin_ns_) return from_;
  const double s = static_cast<double>(time_ns - begin_ns_) / static_cast<double>(end_ns_ - begin_ns_);
  const Vec3 turn = s * turn_;
  const Coefficients k = coefficientsOf(turn.norm());
  const Mat3 w = crossMatrix(turn);
  const Mat3 w2 = w * w;
  const Mat3 rotation = Mat3::Identity() + k.a * w + k.b * w2;
  const Vec3 slide = s * (slide_ + k.b * (w * slide_) + k.c * (w2 * slide_));
  return {rotation * from_.rotation, rotation * from_.origin + slide};
}

Motion Motion::then(const Pose& to, std::int64_t begin_ns, std::int64_t end_ns) const {
  Motion next(to);
  next.earlier_ = begin_ns < last_.begin_ns() ? earlier_ : last_;
  next.last_ = Screw(at(begin_ns), to, begin_ns, end_ns);
  next.identity_ = !next.moves() && to == Pose{};
  return next;
}

std::int64_t Motion::straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const {
  const bool earlier = now_ns < last_.begin_ns();
  const Screw& screw = earlier ? earlier_ : last_;
  if (earlier && moves()) until_ns = std::min(until_ns, last_.begin_ns());
  if (!screw.moves() || screw.angle() == 0) return until_ns;
  const auto whole_ns = static_cast<double>(screw.end_ns() - screw.begin_ns());
  const double way_ns = turn_rad / screw.angle() * whole_ns;
  if (way_ns < static_cast<double>(until_ns - now_ns))
    return now_ns + std::max<std::int64_t>(1, static_cast<std::int64_t>(way_ns));
  return until_ns;
}

Box Motion::reach(const Box& object) const {
  if (object.empty()) return object;
  if (!moves()) return boxAt(object, to());
  Box reach;
  addWay(reach, object, earlier_);
  addWay(reach, object, last_);
  return reach;
}

}  // namespace hl
