#include "io/x3d_joints.h"

#include <array>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "base/direction.h"
#include "bodies/joint_start.h"

namespace hl {

namespace {

class JointsOfX3d {
 public:
  JointsOfX3d(const X3dDocument& document, const X3dBodyNumbers& numbers, SceneModel& scene,
              std::vector<std::string>& warnings)
      : document_(document), numbers_(numbers), scene_(scene), warnings_(warnings) {}

  void add(const X3dNode& node);

 private:
  bool setBodies(const X3dNode& node, JointSpec& joint);
  void setLimits(const X3dNode& node, JointSpec& joint);
  bool moves(std::uint64_t body) const { return body > 0 && !scene_.bodies[body - 1].spec.fixed; }

  const X3dDocument& document_;
  const X3dBodyNumbers& numbers_;
  SceneModel& scene_;
  std::vector<std::string>& warnings_;
};

// False, with a warning: it joins nothing that moves.
bool JointsOfX3d::setBodies(const X3dNode& node, JointSpec& joint) {
  const X3dFields fields(node, warnings_);
  std::array<std::uint64_t, 2> bodies{};  // 0: the world
  std::size_t count = 0;
  for (const X3dNode& child : node.second) {
    if (child.first != "RigidBody") continue;
    const auto field = x3dField(child, "containerField");
    const std::size_t place = field == "body1" ? 0 : field == "body2" ? 1 : count;
    ++count;
    const auto number = numbers_.find(document_.definitionOf(child));
    if (place >= bodies.size() || number == numbers_.end()) {
      fields.warn("is left out: " + nameOfX3d(child) + " is no body here");
      return false;
    }
    bodies[place] = number->second;
  }
  std::tie(joint.body_a, joint.body_b) = std::pair(bodies[0], bodies[1]);
  if (!moves(joint.body_a)) {  // turned round, and the coordinate stays what it was
    std::swap(joint.body_a, joint.body_b);
    joint.axis_W = -joint.axis_W;
  }
  const bool joins = moves(joint.body_a) && joint.body_a != joint.body_b;
  if (!joins) fields.warn("is left out: it joins nothing that moves");
  return joins;
}

// A hinge of X3D knows no more than half a turn to each side: from there on it has no limit.
void JointsOfX3d::setLimits(const X3dNode& node, JointSpec& joint) {
  constexpr double kHalfTurn = std::numbers::pi - 1e-3, kMax = 1e9;
  const bool hinge = joint.kind == JointKind::kHinge;
  const X3dFields fields(node, warnings_);
  const double low = fields.number(hinge ? "minAngle" : "minSeparation", hinge ? -kMax : 0, -kMax, kMax);
  const double high = fields.number(hinge ? "maxAngle" : "maxSeparation", hinge ? kMax : 1, -kMax, kMax);
  if (fields.number("stopBounce", 0, 0, 1) > 0) fields.warn("stopBounce is left out");
  if (low > high) return fields.warn("has no limits: the lower one is above the upper one");
  if (!hinge || low > -kHalfTurn) joint.along.low = low;
  if (!hinge || high < kHalfTurn) joint.along.high = high;
}

void JointsOfX3d::add(const X3dNode& node) {
  const X3dFields fields(node, warnings_);
  if (isX3d(node, {"UniversalJoint", "DoubleAxisHingeJoint", "MotorJoint"}))
    return fields.warn("is not supported, and left out");
  if (!isX3d(node, {"BallJoint", "SingleAxisHingeJoint", "SliderJoint"}) || x3dField(node, "USE")) return;
  if (scene_.mechanics.joints.size() >= kMaxJoints) return fields.warn("is left out: there are 1000 joints");
  JointSpec joint;
  joint.name = labelOfX3d(node);
  if (node.first == "SingleAxisHingeJoint") joint.kind = JointKind::kHinge;
  if (node.first == "SliderJoint") joint.kind = JointKind::kSlider;
  joint.anchor_W = fields.vec("anchorPoint", Vec3::Zero(), kFarthestX3d_m);
  if (joint.kind != JointKind::kBall) {
    const bool slider = joint.kind == JointKind::kSlider;
    const auto axis = unitOf(fields.vec("axis", slider ? Vec3(0, 1, 0) : Vec3(0, 0, 0), kFarthestX3d_m));
    if (!axis) return fields.warn("is left out: it needs an axis");
    joint.axis_W = *axis;
    setLimits(node, joint);
  }
  if (!setBodies(node, joint)) return;
  if (joint.kind == JointKind::kSlider) joint.anchor_W = scene_.bodies[joint.body_a - 1].pose.origin;
  const auto start = [&](std::uint64_t body) {
    return moves(body) ? std::optional(scene_.bodies[body - 1].pose) : std::nullopt;
  };
  if (const std::string fault = startFault(joint, start); !fault.empty()) return fields.warn("is left out: " + fault);
  if (const std::string warning = startWarning(joint, start); !warning.empty()) fields.warn(warning);
  scene_.mechanics.joints.push_back(std::move(joint));
}

}  // namespace

void readX3dJoints(const X3dDocument& document, const X3dBodyNumbers& numbers, SceneModel& scene,
                   std::vector<std::string>& warnings) {
  JointsOfX3d joints(document, numbers, scene, warnings);
  for (const X3dNode* collection : document.all("RigidBodyCollection")) {
    for (const X3dNode& child : collection->second) joints.add(child);
  }
}

}  // namespace hl
