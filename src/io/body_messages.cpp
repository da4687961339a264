#include "io/body_messages.h"

#include <string>

#include "base/error.h"
#include "base/utf8.h"
#include "geometry/primitive.h"
#include "io/value_messages.h"

namespace hl {

namespace {

constexpr const char* kBody = "a body";

// What a RigidBody is made of.
struct BodyParts {
  BodySpec spec;
  Pose start;
  Box object, room;  // of one that moves
};

void checkVec(const std::string& what, const char* name, const Vec3& v, double most) {
  for (int i = 0; i < 3; ++i) checkRanges(what, {{name, v[i], -most, most}});
}

void checkSpec(const BodySpec& spec) {
  constexpr double kMin = 1e-15, kMax = 1e15, kFastest = 1e6;
  const BodySurface& surface = spec.surface;
  checkRanges(kBody, {{"mass_kg", spec.mass_kg.value_or(1), kMin, kMax},
                      {"density_kg_m3", spec.density_kg_m3, kMin, kMax},
                      {"dynamic_friction", surface.dynamic_friction, 0, kMax},
                      {"static_friction", surface.static_friction, surface.dynamic_friction, kMax},
                      {"restitution", surface.restitution, 0, 1}});
  checkVec(kBody, "velocity_m_s", spec.velocity_m_s, kFastest);
  checkVec(kBody, "spin_rad_s", spec.spin_rad_s, kFastest);
}

void checkBox(const Box& box) {
  if (box.empty() || !withinReach(box.min) || !withinReach(box.max))
    throw Error("a body makes no sense: its bounds are empty, or out of reach");
}

BodyParts partsOfBody(const proto::RecordedBody& in) {
  BodyParts parts;
  readValues(in.body(), kBody, parts);
  checkSpec(parts.spec);
  checkRecorded(parts.start, kBody);
  return parts;
}

// What a JointSpec is made of, without its name and table.
struct JointParts {
  std::uint64_t key = 0;
  JointKind kind{};
  std::uint64_t body_a = 0, body_b = 0;
  Vec3 anchor_W, anchor_b_W, axis_W;
  double low = 0, high = 0, rest = 0, spring = 0, damping = 0, friction = 0;
  bool collide = false;

  static JointParts of(const JointSpec& joint) {
    const JointForces& along = joint.along;
    return {joint.key, joint.kind, joint.body_a, joint.body_b, joint.anchor_W, joint.anchor_b_W, joint.axis_W,
            along.low, along.high, along.rest,   along.spring, along.damping,  along.friction,   joint.collide};
  }
};

// What would not be a joint is refused with the world that it is in (joint_check.h).
JointSpec jointOf(const proto::RecordedJoint& in) {
  constexpr double kMaxPlace_m = 1e9;
  constexpr const char* kJoint = "a joint";
  JointParts parts;
  readValues(in.joint(), kJoint, parts);
  for (const Vec3& place : {parts.anchor_W, parts.anchor_b_W, parts.axis_W})
    checkVec(kJoint, "a place", place, kMaxPlace_m);
  JointSpec joint{in.name(),      parts.kind,       parts.body_a, parts.body_b,
                  parts.anchor_W, parts.anchor_b_W, parts.axis_W, {}};
  joint.along = {parts.low, parts.high, parts.rest, parts.spring, parts.damping, parts.friction, {}};
  joint.along.table.position.assign(in.table_position().begin(), in.table_position().end());
  joint.along.table.force.assign(in.table_force().begin(), in.table_force().end());
  joint.collide = parts.collide;
  joint.key = parts.key;
  return joint;
}

}  // namespace

void toProto(const RigidBody& body, proto::RecordedBody& out) {
  BodyParts parts{body.spec, body.start, {}, {}};
  if (body.poses) {
    parts.object = body.poses->object();
    parts.room = body.poses->room();
  }
  out.set_name(validUtf8(body.name));
  toProto(valuesOf(parts), *out.mutable_body());
}

void toProto(const SceneBody& body, proto::RecordedBody& out) {
  out.set_name(validUtf8(body.name));
  toProto(valuesOf(BodyParts{body.spec, body.pose, {}, {}}), *out.mutable_body());
}

std::shared_ptr<const RigidBody> rigidBodyOf(const proto::RecordedBody& in) {
  const BodyParts parts = partsOfBody(in);
  if (!parts.spec.fixed) {
    checkBox(parts.object);
    checkBox(parts.room);
  }
  return makeRigidBody(in.name(), parts.spec, parts.start, parts.object, parts.room);
}

SceneBody sceneBodyOf(const proto::RecordedBody& in) {
  const BodyParts parts = partsOfBody(in);
  return {in.name(), {}, parts.start, parts.spec};
}

void toProto(const Mechanics& mechanics, proto::RecordedMechanics& out) {
  for (const double component : mechanics.gravity_m_s2) out.add_gravity_m_s2(component);
  for (const JointSpec& joint : mechanics.joints) {
    proto::RecordedJoint& recorded = *out.add_joints();
    recorded.set_name(validUtf8(joint.name));
    toProto(valuesOf(JointParts::of(joint)), *recorded.mutable_joint());
    const ForceTable& table = joint.along.table;
    recorded.mutable_table_position()->Add(table.position.begin(), table.position.end());
    recorded.mutable_table_force()->Add(table.force.begin(), table.force.end());
  }
}

Mechanics mechanicsOf(const proto::RecordedMechanics& in) {
  constexpr double kMax_m_s2 = 1e6;
  constexpr const char* kWhat = "what acts on bodies";
  Mechanics mechanics;
  if (in.gravity_m_s2_size() != 3) throw Error(std::string(kWhat) + " makes no sense: gravity has three components");
  mechanics.gravity_m_s2 = {in.gravity_m_s2(0), in.gravity_m_s2(1), in.gravity_m_s2(2)};
  checkVec(kWhat, "gravity_m_s2", mechanics.gravity_m_s2, kMax_m_s2);
  for (const proto::RecordedJoint& joint : in.joints()) mechanics.joints.push_back(jointOf(joint));
  return mechanics;
}

}  // namespace hl
