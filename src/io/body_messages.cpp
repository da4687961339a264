#include "io/body_messages.h"

#include "base/error.h"
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
  constexpr double kLeast = 1e-15, kMost = 1e15, kFastest = 1e6;
  const BodySurface& surface = spec.surface;
  checkRanges(kBody, {{"mass_kg", spec.mass_kg.value_or(1), kLeast, kMost},
                      {"density_kg_m3", spec.density_kg_m3, kLeast, kMost},
                      {"dynamic_friction", surface.dynamic_friction, 0, kMost},
                      {"static_friction", surface.static_friction, surface.dynamic_friction, kMost},
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

}  // namespace

void toProto(const RigidBody& body, proto::RecordedBody& out) {
  BodyParts parts{body.spec, body.start, {}, {}};
  if (body.poses) {
    parts.object = body.poses->object();
    parts.room = body.poses->room();
  }
  out.set_name(body.name);
  toProto(valuesOf(parts), *out.mutable_body());
}

void toProto(const SceneBody& body, proto::RecordedBody& out) {
  out.set_name(body.name);
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

Mechanics mechanicsOf(const proto::Values& in) {
  constexpr double kMost_m_s2 = 1e6;
  constexpr const char* kWhat = "what acts on bodies";
  Mechanics mechanics;
  readValues(in, kWhat, mechanics);
  checkVec(kWhat, "gravity_m_s2", mechanics.gravity_m_s2, kMost_m_s2);
  return mechanics;
}

}  // namespace hl
