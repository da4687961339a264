#include "page/layout_bodies.h"

#include <algorithm>
#include <cmath>

#include "base/utf8.h"
#include "page/wire_bytes.h"
#include "session/state_messages.h"

namespace hl {

namespace {

bool sameBody(const std::shared_ptr<const RigidBody>& a, const std::shared_ptr<const RigidBody>& b) {
  return a == b || (a && b && a->spec == b->spec && a->start == b->start);
}

// Where else it is reported what the joint does is no part of the joint.
bool sameJoint(const JointSpec& a, JointSpec b) {
  b.shown = a.shown;
  return a == b;
}

// As a scene file says it, which the page may write: what has no effect is left out.
void describeBody(const RigidBody& body, proto::PlacedMesh& placed) {
  const BodySpec& spec = body.spec;
  proto::Body& out = *placed.mutable_body();
  out.set_fixed(spec.fixed);
  if (spec.mass_kg && !spec.fixed) out.set_mass_kg(*spec.mass_kg);
  if (!spec.mass_kg && !spec.fixed) out.set_density_kg_m3(spec.density_kg_m3);
  out.set_shape(static_cast<proto::BodyShape>(spec.shape));
  out.set_static_friction(spec.surface.static_friction);
  out.set_dynamic_friction(spec.surface.dynamic_friction);
  out.set_restitution(spec.surface.restitution);
  toProto(spec.velocity_m_s, *out.mutable_velocity_m_s());
  toProto(spec.spin_rad_s, *out.mutable_spin_rad_s());
  appendPose(*placed.mutable_start(), body.start);
}

void describeJoint(const JointSpec& joint, proto::Joint& out) {
  const JointForces& along = joint.along;
  out.set_name(printable(joint.name));
  out.set_kind(static_cast<proto::JointKind>(joint.kind));
  toProto(joint.anchor_W, *out.mutable_anchor());
  if (joint.kind == JointKind::kDistance) toProto(joint.anchor_b_W, *out.mutable_anchor_b());
  if (hasAxis(joint.kind)) toProto(joint.axis_W, *out.mutable_axis());
  if (std::isfinite(along.low)) out.set_low(along.low);
  if (std::isfinite(along.high)) out.set_high(along.high);
  if (along.spring > 0) out.set_rest(along.rest);
  out.set_spring(along.spring);
  out.set_damping(along.damping);
  out.set_friction(along.friction);
  if (!along.table.position.empty()) {
    out.mutable_table()->mutable_position()->Add(along.table.position.begin(), along.table.position.end());
    out.mutable_table()->mutable_force()->Add(along.table.force.begin(), along.table.force.end());
  }
  out.set_collide(joint.collide);
}

}  // namespace

LayoutBodies LayoutBodies::of(const Snapshot& snapshot) {
  LayoutBodies contents{{}, snapshot.mechanics};
  contents.bodies.reserve(snapshot.instances.size());
  for (const Instance& instance : snapshot.instances) contents.bodies.push_back(instance.body);
  return contents;
}

bool LayoutBodies::operator==(const LayoutBodies& other) const {
  return mechanics.gravity_m_s2 == other.mechanics.gravity_m_s2 &&
         std::equal(bodies.begin(), bodies.end(), other.bodies.begin(), other.bodies.end(), sameBody) &&
         std::equal(mechanics.joints.begin(), mechanics.joints.end(), other.mechanics.joints.begin(),
                    other.mechanics.joints.end(), sameJoint);
}

void addBodies(const LayoutBodies& contents, const Snapshot& snapshot, proto::SceneLayout& layout) {
  bool any = false;
  for (std::size_t i = 0; i < contents.bodies.size(); ++i) {
    if (!contents.bodies[i]) continue;
    any = true;
    describeBody(*contents.bodies[i], *layout.mutable_placed(static_cast<int>(i)));
  }
  if (!any) return;
  toProto(contents.mechanics.gravity_m_s2, *layout.mutable_gravity_m_s2());
  for (const JointSpec& joint : contents.mechanics.joints) {
    std::uint32_t a = 0, b = 0;
    if (!snapshot.find(joint.body_a, a) || (joint.body_b != 0 && !snapshot.find(joint.body_b, b))) continue;
    proto::PlacedJoint& placed = *layout.add_joints();
    describeJoint(joint, *placed.mutable_joint());
    placed.set_body_a(a);
    if (joint.body_b != 0) placed.set_body_b(b);
  }
}

}  // namespace hl
