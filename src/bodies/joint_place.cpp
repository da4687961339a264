#include "bodies/joint_place.h"

#include <cmath>

#include "base/plain_math.h"

namespace hl {

namespace {

// The angle of (x, y), -pi..pi.
double angleOfAny(double x, double y) {
  if (x == 0 && y == 0) return 0;
  const double first = plain::angleOf(std::abs(x), std::abs(y));
  const double half = x < 0 ? EIGEN_PI - first : first;
  return y < 0 ? -half : half;
}

}  // namespace

JointPlace::JointPlace(const Joint& of, const Pose& a, const Pose& b)
    : joint(of),
      point_a(a.toWorld(of.anchor_a)),
      point_b(b.toWorld(of.anchor_b)),
      axis_a(a.turnToWorld(of.axis_a)),
      axis_b(b.turnToWorld(of.axis_b)),
      side_a(a.turnToWorld(of.side_a)),
      side_b(b.turnToWorld(of.side_b)) {}

Vec3 JointPlace::direction() const {
  const Vec3 way = point_a - point_b;
  const double distance = way.norm();
  return distance > 0 ? Vec3(way / distance) : axis_b;
}

double JointPlace::coordinate(double last) const {
  if (joint.kind == JointKind::kSlider) return axis_b.dot(point_a - point_b);
  if (joint.kind == JointKind::kDistance) return (point_a - point_b).norm();
  if (joint.kind != JointKind::kHinge) return 0;
  const double angle = angleOfAny(side_b.dot(side_a), axis_b.dot(side_b.cross(side_a)));
  return angle + 2 * EIGEN_PI * std::round((last - angle) / (2 * EIGEN_PI));
}

// A direction of body b that a slides along turns with b: so both arms end at the anchor of a.
JointAxis JointPlace::alongCoordinate(const Vec3& centre_a, const Vec3& centre_b) const {
  if (joint.kind == JointKind::kHinge) return {Vec3::Zero(), axis_b, axis_b};
  const bool slides = joint.kind == JointKind::kSlider;
  const Vec3 line = slides ? axis_b : direction();
  return {line, (point_a - centre_a).cross(line), ((slides ? point_a : point_b) - centre_b).cross(line)};
}

// A slider holds across its axis and all turns; the others hold the point, a hinge the turns across its axis.
JointPlace::Held JointPlace::heldBy(std::size_t number) const {
  const auto unit = [](std::size_t i) { return Vec3(Vec3::Unit(static_cast<Eigen::Index>(i))); };
  if (joint.kind == JointKind::kSlider) {
    if (number >= 2) return {unit(number - 2), true};
    return {number == 0 ? side_b : thirdSide_b(), false};
  }
  if (joint.kind == JointKind::kDistance) return {direction(), false};
  if (number < 3) return {unit(number), false};
  if (joint.kind == JointKind::kFixed) return {unit(number - 3), true};
  return {number == 3 ? side_b : thirdSide_b(), true};
}

JointAxis JointPlace::row(std::size_t number, double lever_m, const Vec3& centre_a, const Vec3& centre_b) const {
  const Held held = heldBy(number);
  if (held.turns) return {Vec3::Zero(), lever_m * held.direction, lever_m * held.direction};
  const Vec3 end_b = joint.kind == JointKind::kSlider ? point_a : point_b;
  return {held.direction, (point_a - centre_a).cross(held.direction), (end_b - centre_b).cross(held.direction)};
}

// Rad, for small angles: the turn of a against b; of a hinge that of its axis.
Vec3 JointPlace::offTurn() const {
  if (joint.kind == JointKind::kHinge) return axis_b.cross(axis_a);
  return (axis_b.cross(axis_a) + side_b.cross(side_a) + thirdSide_b().cross(axis_a.cross(side_a))) / 2;
}

Vec6 JointPlace::off(double lever_m) const {
  Vec6 off = Vec6::Zero();
  Vec3 apart = point_a - point_b;
  if (isRod(joint)) apart -= joint.low * direction();
  const Vec3 turn = lever_m * offTurn();
  for (std::size_t i = 0; i < heldRows(joint); ++i) {
    const Held one = heldBy(i);
    off[static_cast<Eigen::Index>(i)] = one.direction.dot(one.turns ? turn : apart);
  }
  return off;
}

}  // namespace hl
