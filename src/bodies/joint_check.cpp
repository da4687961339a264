#include "bodies/joint_check.h"

#include <cmath>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

// Of unit length and of right angles: what is left of a value that was written with six digits.
constexpr double kUnit = 1e-5;

// One that was given no limits has its length at the start as both.
constexpr const char* kDistanceOfNone =
    "its distance can only be 0: place its two anchors apart, or give it a limit high > 0";

class JointChecker {
 public:
  explicit JointChecker(const Joint& joint) : joint_(joint) {}

  void demand(bool holds, const char* what) const {
    if (!holds) throw Error(what);
  }
  void bodies(const std::function<bool(std::uint64_t)>& is_body) const {
    demand(joint_.key != 0, "its key must be greater than 0");
    demand(is_body(joint_.body_a), "body_a is no body of the world");
    demand(joint_.body_b == 0 || is_body(joint_.body_b), "body_b is no body of the world, and not 0");
    demand(joint_.body_a != joint_.body_b, "body_a and body_b must be two bodies");
  }
  void frames() const {
    demand(joint_.anchor_a.allFinite() && joint_.anchor_b.allFinite(), "an anchor is not finite");
    for (const auto& [axis, side] :
         {std::pair{joint_.axis_a, joint_.side_a}, std::pair{joint_.axis_b, joint_.side_b}}) {
      demand(std::abs(axis.norm() - 1) < kUnit && std::abs(side.norm() - 1) < kUnit, "axis and side must be unit");
      demand(std::abs(axis.dot(side)) < kUnit, "its side must be across its axis");
    }
  }
  void forces() const {
    demand(joint_.low <= joint_.high, "low must not exceed high");
    demand(joint_.kind != JointKind::kDistance || joint_.high > 0, kDistanceOfNone);
    demand(std::isfinite(joint_.rest), "rest is not finite");
    for (const double value : {joint_.spring, joint_.damping, joint_.friction})
      demand(std::isfinite(value) && value >= 0, "spring, damping and friction must be finite and >= 0");
    if (hasCoordinate(joint_.kind)) return;
    demand(joint_.spring == 0 && joint_.damping == 0 && joint_.friction == 0 && joint_.table.empty() &&
               std::isinf(joint_.low) && std::isinf(joint_.high),
           "a ball or fixed joint has no coordinate: leave out limits, spring, damping, friction and table");
  }
  void table() const {
    const ForceTable& table = joint_.table;
    demand(table.position.size() == table.force.size(), "its table must have a force for each position");
    demand(table.position.size() <= kMaxTableRows, "its table must have at most 256 rows");
    for (std::size_t i = 0; i < table.position.size(); ++i) {
      demand(std::isfinite(table.position[i]) && std::isfinite(table.force[i]), "its table has a value not finite");
      demand(i == 0 || table.position[i - 1] < table.position[i], "the positions of its table must increase");
    }
  }

 private:
  const Joint& joint_;
};

void refuse(const Joint& joint, const std::string& fault) {
  throw Error("joint " + std::to_string(joint.key) + ": " + fault);
}

}  // namespace

std::string faultOfJoint(const Joint& joint, const std::function<bool(std::uint64_t)>& is_body) {
  const JointChecker checker(joint);
  try {
    checker.bodies(is_body);
    checker.frames();
    checker.forces();
    checker.table();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void checkJoint(const Joint& joint, const std::function<bool(std::uint64_t)>& is_body) {
  const std::string fault = faultOfJoint(joint, is_body);
  if (!fault.empty()) refuse(joint, fault);
}

void checkJoints(std::span<const Joint> joints, const std::function<bool(std::uint64_t)>& is_body) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    checkJoint(joints[i], is_body);
    if (i > 0 && joints[i - 1].key >= joints[i].key) refuse(joints[i], "joints must be sorted by key, each key once");
  }
}

}  // namespace hl
