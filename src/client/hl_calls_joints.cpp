// Joints: what holds bodies together, and what the joints do.
#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "client/call.h"
#include "client/queries.h"
#include "client/vec_messages.h"

using hl::client::call;
using hl::client::callOr;
using hl::client::Fault;
using hl::client::requireList;
using hl::client::requirePointer;
using hl::client::requireWithin;
using hl::client::When;

namespace {

// As servers take them: along the coordinate m, rad, N, N m and what is made of them.
constexpr double kMaxAlong = 1e9, kFarthestAnchor_m = 1e6;
constexpr HLsizei kMaxRows = 256;
constexpr std::array<std::string_view, HL_JOINT_FRICTION - HL_JOINT_LOW + 1> kNamesAlong{
    "HL_JOINT_LOW", "HL_JOINT_HIGH", "HL_JOINT_REST", "HL_JOINT_SPRING", "HL_JOINT_DAMPING", "HL_JOINT_FRICTION"};

// Lets `fill` set the joint that is made next.
template <typename Fill>
void setJoint(const char* function, Fill fill) {
  call(function, When::kNotInDefinition, [&](HLcontext& context) { fill(context.joint); });
}

void setAlong(hl::proto::Joint& joint, HLenum parameter, double value) {
  const bool signed_value = parameter >= HL_JOINT_LOW && parameter <= HL_JOINT_REST;
  if (parameter < HL_JOINT_LOW || parameter > HL_JOINT_FRICTION)
    throw Fault(HL_INVALID_ENUM, "the parameter must be HL_JOINT_LOW .. HL_JOINT_FRICTION");
  requireWithin(kNamesAlong[parameter - HL_JOINT_LOW], value, signed_value ? -kMaxAlong : 0, kMaxAlong);
  switch (parameter) {
    case HL_JOINT_LOW:
      return joint.set_low(value);
    case HL_JOINT_HIGH:
      return joint.set_high(value);
    case HL_JOINT_REST:
      return joint.set_rest(value);
    case HL_JOINT_SPRING:
      return joint.set_spring(value);
    case HL_JOINT_DAMPING:
      return joint.set_damping(value);
    default:
      return joint.set_friction(value);
  }
}

void setKind(hl::proto::Joint& joint, HLenum parameter, HLint value) {
  const auto named = static_cast<HLenum>(value);
  if (parameter == HL_JOINT_COLLIDE) return joint.set_collide(value != HL_FALSE);
  if (parameter != HL_JOINT_KIND)
    throw Fault(HL_INVALID_ENUM, "the parameter must be HL_JOINT_KIND or HL_JOINT_COLLIDE");
  if (named < HL_JOINT_BALL || named > HL_JOINT_DISTANCE)
    throw Fault(HL_INVALID_ENUM, "the kind must be HL_JOINT_BALL .. HL_JOINT_DISTANCE");
  joint.Clear();
  joint.set_kind(static_cast<hl::proto::JointKind>(named - HL_JOINT_BALL));
}

hl::proto::Vec3 placeOf(const hl::Vec3& v) {
  for (const double value : v) requireWithin("each coordinate", value, -kFarthestAnchor_m, kFarthestAnchor_m);
  hl::proto::Vec3 place;
  hl::client::setVec(place, v.x(), v.y(), v.z());
  return place;
}

void setVector(HLcontext& context, HLenum parameter, const hl::Vec3& given) {
  const hl::client::Matrix4& matrix = context.draw.modelview.top();
  const hl::Vec3 turned = matrix.topLeftCorner<3, 3>() * given;
  const hl::Vec3 placed = turned + matrix.topRightCorner<3, 1>();
  hl::proto::Joint& joint = context.joint;
  switch (parameter) {
    case HL_JOINT_ANCHOR:
      *joint.mutable_anchor() = placeOf(placed);
      return;
    case HL_JOINT_ANCHOR_B:
      *joint.mutable_anchor_b() = placeOf(placed);
      return;
    case HL_JOINT_AXIS:
      if (!(turned.stableNorm() > 0)) throw Fault(HL_INVALID_VALUE, "the axis must be finite, and not 0");
      *joint.mutable_axis() = placeOf(turned.stableNormalized());
      return;
    default:
      throw Fault(HL_INVALID_ENUM, "the parameter must be HL_JOINT_ANCHOR, HL_JOINT_ANCHOR_B or HL_JOINT_AXIS");
  }
}

hl::proto::ForceTable tableOf(HLsizei rows, const HLdouble* positions, const HLdouble* forces) {
  if (rows > kMaxRows) throw Fault(HL_INVALID_VALUE, "a table has at most 256 rows");
  hl::proto::ForceTable table;
  for (HLsizei i = 0; i < rows; ++i) {
    requireWithin("each position", positions[i], -kMaxAlong, kMaxAlong);
    requireWithin("each force", forces[i], -kMaxAlong, kMaxAlong);
    if (i > 0 && !(positions[i] > positions[i - 1])) throw Fault(HL_INVALID_VALUE, "the positions must increase");
    table.add_position(positions[i]);
    table.add_force(forces[i]);
  }
  return table;
}

void requireComplete(const hl::proto::Joint& joint) {
  const bool slides_or_turns = joint.kind() == hl::proto::HINGE || joint.kind() == hl::proto::SLIDER;
  if (slides_or_turns && !joint.has_axis())
    throw Fault(HL_INVALID_OPERATION, "a hinge or slider needs an axis: hlJoint3d(HL_JOINT_AXIS, ..)");
  if (joint.has_low() && joint.has_high() && joint.low() > joint.high())
    throw Fault(HL_INVALID_OPERATION, "HL_JOINT_LOW must not be above HL_JOINT_HIGH");
  if (joint.kind() == hl::proto::DISTANCE && joint.has_high() && joint.high() <= 0)
    throw Fault(HL_INVALID_OPERATION, "HL_JOINT_HIGH of a distance must be above 0");
  if (slides_or_turns || joint.kind() == hl::proto::DISTANCE) return;
  if (joint.has_low() || joint.has_high() || joint.spring() > 0 || joint.damping() > 0 || joint.friction() > 0 ||
      joint.table().position_size() > 0)
    throw Fault(HL_INVALID_OPERATION, "a ball or fixed joint has no coordinate: no limits, spring, .. along it");
}

void requireBodies(const HLcontext& context, const hl::proto::WorldJoint& joint) {
  const hl::proto::CalledBody &a = joint.body_a(), &b = joint.body_b();
  const bool world = b.object() == 0;
  if (!context.objects.isDefined(a.object()) || (!world && !context.objects.isDefined(b.object())))
    throw Fault(HL_INVALID_VALUE, "an object that it joins is not defined");
  if (a.object() == b.object() && a.name() == b.name()) throw Fault(HL_INVALID_VALUE, "it joins a body to itself");
}

void setCalled(hl::proto::CalledBody& body, HLuint object, HLuint name) {
  body.set_object(object);
  if (name != 0) body.set_name(name);
}

void writeJoint(const HLjoint& joint, HLenum name, HLdouble* values) {
  switch (name) {
    case HL_JOINT_COORDINATE:
      *values = joint.coordinate;
      return;
    case HL_JOINT_VELOCITY:
      *values = joint.velocity;
      return;
    case HL_JOINT_FORCE:
      *values = joint.force;
      return;
    default:
      std::copy_n(joint.hold, 3, values);
  }
}

}  // namespace

void hlJointf(HLenum parameter, HLfloat value) {
  setJoint(__func__, [&](hl::proto::Joint& joint) { setAlong(joint, parameter, double{value}); });
}
void hlJointd(HLenum parameter, HLdouble value) {
  setJoint(__func__, [&](hl::proto::Joint& joint) { setAlong(joint, parameter, value); });
}
void hlJointi(HLenum parameter, HLint value) {
  setJoint(__func__, [&](hl::proto::Joint& joint) { setKind(joint, parameter, value); });
}

void hlJoint3d(HLenum parameter, HLdouble x, HLdouble y, HLdouble z) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) { setVector(context, parameter, hl::Vec3(x, y, z)); });
}

void hlJointTable(HLsizei rows, const HLdouble* positions, const HLdouble* forces) {
  setJoint(__func__, [&](hl::proto::Joint& joint) {
    requireList(rows, positions);
    requireList(rows, forces);
    *joint.mutable_table() = tableOf(rows, positions, forces);
  });
}

void hlJoin(HLuint joint, HLuint object_a, HLuint name_a, HLuint object_b, HLuint name_b) {
  call(__func__, When::kNotInDefinition, [&](HLcontext& context) {
    if (joint == 0) throw Fault(HL_INVALID_VALUE, "joints count from 1");
    hl::proto::WorldJoint made;
    made.set_id(joint);
    setCalled(*made.mutable_body_a(), object_a, name_a);
    if (object_b != 0) setCalled(*made.mutable_body_b(), object_b, name_b);
    requireBodies(context, made);
    requireComplete(context.joint);
    std::vector<hl::proto::WorldJoint>& all = context.target().joints();
    if (std::any_of(all.begin(), all.end(), [&](const auto& other) { return other.id() == joint; }))
      throw Fault(HL_INVALID_VALUE, "this frame has a joint of this number");
    *made.mutable_joint() = context.joint;
    all.push_back(std::move(made));
    context.joint.Clear();
  });
}

HLsizei hlGetJoints(HLsizei most, HLjoint* joints) {
  return hl::client::getList(__func__, most, joints, hl::client::jointsOf);
}

HLboolean hlGetJointdv(HLuint joint, HLenum name, HLdouble* values) {
  return callOr<HLboolean>(HL_FALSE, __func__, When::kOutside, [&](HLcontext& context) -> HLboolean {
    if ((name < HL_JOINT_COORDINATE || name > HL_JOINT_FORCE) && name != HL_JOINT_HOLD)
      throw Fault(HL_INVALID_ENUM, "the name must be HL_JOINT_COORDINATE .. HL_JOINT_FORCE or HL_JOINT_HOLD");
    requirePointer(values);
    for (const HLjoint& one : hl::client::jointsOf(context)) {
      if (one.joint != joint) continue;
      writeJoint(one, name, values);
      return HL_TRUE;
    }
    return HL_FALSE;
  });
}
