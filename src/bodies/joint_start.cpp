#include "bodies/joint_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "bodies/joint_check.h"
#include "bodies/joint_place.h"

namespace hl {

namespace {

// A limit that was computed, or written with its bodies in single precision, may be passed by this part of its size or
// theirs.
constexpr double kRoundedLimit = 1e-6;

// The same joint, described from its other side: with its axis turned round the coordinate stays what it is.
JointSpec turnedRound(JointSpec spec) {
  std::swap(spec.body_a, spec.body_b);
  if (spec.kind == JointKind::kDistance) std::swap(spec.anchor_W, spec.anchor_b_W);
  spec.axis_W = -spec.axis_W;
  return spec;
}

// How far from the origin joint and bodies are, m; of a hinge a radian.
double reachOfJoint(const JointPlace& place, const Pose& a, const Pose& b) {
  if (place.joint.kind == JointKind::kHinge) return 1;
  return std::max({place.point_a.norm(), place.point_b.norm(), a.origin.norm(), b.origin.norm()});
}

}  // namespace

Joint jointOf(const JointSpec& spec, const Pose& start_a, const Pose& start_b) {
  Joint joint = spec.kind == JointKind::kDistance ? distanceBetween(spec.anchor_W, spec.anchor_b_W, start_a, start_b)
                                                  : jointAt(spec.kind, spec.anchor_W, spec.axis_W, start_a, start_b);
  const JointForces as_it_stands = joint;  // of a distance
  static_cast<JointForces&>(joint) = spec.along;
  if (spec.kind == JointKind::kDistance && spec.along == JointForces{}) static_cast<JointForces&>(joint) = as_it_stands;
  joint.key = spec.key;
  joint.body_a = spec.body_a;
  joint.body_b = spec.body_b;
  joint.collide = spec.collide;
  return joint;
}

std::optional<Joint> steppedJoint(JointSpec spec, const StartOfBody& start) {
  if (!start(spec.body_a)) spec = turnedRound(std::move(spec));
  const std::optional<Pose> a = start(spec.body_a), b = start(spec.body_b);
  if (!a) return {};
  if (!b) spec.body_b = 0;
  return jointOf(spec, *a, b.value_or(Pose()));
}

std::string startFault(JointSpec spec, const StartOfBody& start) {
  spec.key = std::max<std::uint64_t>(spec.key, 1);
  const std::optional<Joint> joint = steppedJoint(spec, start);
  if (!joint) return {};
  return faultOfJoint(*joint, [&](std::uint64_t key) { return start(key).has_value(); });
}

// A rod goes to its length; other limits hold what is outside of them, and do not bring it back.
std::string startWarning(const JointSpec& spec, const StartOfBody& start) {
  const std::optional<Joint> joint = steppedJoint(spec, start);
  if (!joint) return "joins nothing that moves, and has no effect";
  if (!hasCoordinate(joint->kind) || isRod(*joint)) return {};
  const Pose a = start(joint->body_a).value_or(Pose()), b = start(joint->body_b).value_or(Pose());
  const JointPlace place(*joint, a, b);
  const double low = joint->low, high = joint->high, exact = place.coordinate(0), size = reachOfJoint(place, a, b);
  const auto rounding = [size](double limit) { return kRoundedLimit * std::max(size, std::abs(limit)); };
  if (exact >= low - rounding(low) && exact <= high + rounding(high)) return {};
  const double coordinate = std::abs(exact) > rounding(0) ? exact : 0;  // and not -0
  const char* const unit = joint->kind == JointKind::kHinge ? "rad" : "m";
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "starts at %.4g %s, outside its limits of %.4g .. %.4g %s, and stays there until something moves it",
                coordinate, unit, low, high, unit);
  return text.data();
}

}  // namespace hl
