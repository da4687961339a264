#include "io/scene_mechanics.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "bodies/joint_start.h"
#include "bodies/mesh_body.h"
#include "builtin.h"

namespace hl {

namespace {

std::string namedJoint(const proto::Joint& in, const std::string& where) {
  return in.name().empty() ? where : where + " ('" + in.name() + "')";
}

}  // namespace

// A mass that has no effect is no error, as scenes that a page saved may have one. Pages have written the usual density
// with each body: that one is as if it were left out.
BodySpec SceneMechanics::body(const proto::SceneObject& object, const std::string& where) const {
  const std::string at = where + ".body";
  const proto::Body& in = object.body();
  if (object.has_builtin() && hasBuiltinBodies(object.builtin()))
    fail(at, at + ": '" + object.builtin() + "' has bodies of its own, and stays where it is as one object");
  const BodySpec spec = decoder_.body(in, at);
  if (spec.fixed && (spec.velocity_m_s != Vec3::Zero() || spec.spin_rad_s != Vec3::Zero()))
    fail(at, at + ": a fixed body has no velocityMS and no spinRadS");
  const bool has_density = in.has_density_kg_m3() && spec.density_kg_m3 != BodySpec().density_kg_m3;
  if (spec.fixed && (in.has_mass_kg() || has_density))
    warn_(at, at + ": a fixed body does not move, and its massKg and densityKgM3 have no effect");
  else if (in.has_mass_kg() && has_density)
    warn_(at + ".densityKgM3", at + ".densityKgM3 has no effect beside massKg");
  return spec;
}

// Numbers from 1, as a scene's joints have them.
std::uint64_t SceneMechanics::bodyNamed(const std::string& name, const SceneModel& scene,
                                        const std::string& where) const {
  if (name.empty()) fail(where, where + " must name a body");
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name != name) continue;
    if (found != 0) fail(where, where + ": there are several bodies '" + name + "' in this scene");
    found = i + 1;
  }
  if (found == 0) fail(where, where + ": there is no body '" + name + "' in this scene");
  return found;
}

// A joint without a part of what its author wrote would move in another way.
void SceneMechanics::requireOfKind(const proto::Joint& in, const JointSpec& joint, const std::string& where) const {
  const auto require = [&](bool holds, const char* name, const char* what) {
    if (!holds) fail(where + name, where + name + what);
  };
  const bool is_distance = joint.kind == JointKind::kDistance;
  require(hasAxis(joint.kind) || !in.has_axis(), ".axis", ": only a hinge or slider has an axis");
  require(is_distance || !in.has_anchor_b(), ".anchorB", ": only a distance has an anchorB");
  require(!is_distance || joint.along.high > 0, ".high", " of a distance must be greater than 0");
  require(!is_distance || !in.has_low() || in.low() >= 0, ".low", " of a distance must not be below 0");
  const bool is_bare = joint.along == JointForces{};
  require(hasCoordinate(joint.kind) || is_bare, "",
          ": a ball or fixed joint has no coordinate: leave out low, high, rest, spring, damping, friction and table");
  require(!in.has_table() || !joint.along.table.empty(), ".table", " must have a row or more: leave it out for none");
  if (joint.along.rest != 0 && joint.along.spring == 0)
    warn_(where + ".rest", where + ".rest has no effect without a spring");
}

void SceneMechanics::addJoints(const proto::Scene& in, SceneModel& scene) const {
  if (in.joints_size() > static_cast<int>(kMaxJoints)) fail("joints", "there are more than 1000 joints in it");
  for (int i = 0; i < in.joints_size(); ++i) {
    const proto::Joint& one = in.joints(i);
    const std::string where = pathOf("joints", i);
    JointSpec joint = decoder_.joint(one, where);
    requireOfKind(one, joint, where);
    joint.body_a = bodyNamed(one.body_a(), scene, where + ".bodyA");
    if (!one.body_b().empty()) joint.body_b = bodyNamed(one.body_b(), scene, where + ".bodyB");
    if (joint.body_a == joint.body_b) fail(where, where + " joins a body to itself");
    scene.mechanics.joints.push_back(std::move(joint));
  }
  warnOfNames(in);
}

void SceneMechanics::warnOfNames(const proto::Scene& in) const {
  std::map<std::string, int> times;
  for (int i = 0; i < in.joints_size(); ++i) {
    const std::string& name = in.joints(i).name();
    const std::string where = pathOf("joints", i) + ".name";
    if (!name.empty() && ++times[name] == 2) warn_(where, where + ": there are several joints '" + name + "'");
  }
}

void SceneMechanics::check(const proto::Scene& in, const SceneModel& scene) const {
  checkBodies(in, scene);
  checkJoints(in, scene);
}

void SceneMechanics::checkBodies(const proto::Scene& in, const SceneModel& scene) const {
  const auto moving =
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [](const auto& b) { return !b.spec.fixed; });
  if (moving > static_cast<std::ptrdiff_t>(kMaxBodies))
    fail("objects", fmt::format("{} bodies can move, and at most {} may: set fixed of the others", moving, kMaxBodies));
  std::size_t body = 0, parts = 0;
  for (int i = 0; i < in.objects_size(); ++i) {
    if (!in.objects(i).has_body()) continue;
    const SceneBody& one = scene.bodies[body++];
    const std::string where = pathOf("objects", i) + ".body";
    try {
      if (!one.spec.fixed) parts += bodyOf(one.model, one.spec).shape.parts.size();
    } catch (const Error& error) {
      fail(where, where + ": " + error.what());
    }
    if (parts > kMaxBodies)
      fail(where,
           fmt::format("with {} the bodies that move have {} parts, and at most {} may", where, parts, kMaxBodies));
  }
}

void SceneMechanics::checkJoints(const proto::Scene& in, const SceneModel& scene) const {
  const auto start = [&](std::uint64_t number) -> std::optional<Pose> {
    if (number == 0 || scene.bodies[number - 1].spec.fixed) return {};
    return scene.bodies[number - 1].pose;
  };
  for (int i = 0; i < in.joints_size(); ++i) {
    const JointSpec& joint = scene.mechanics.joints[static_cast<std::size_t>(i)];
    const std::string where = pathOf("joints", i), name = namedJoint(in.joints(i), where);
    if (const std::string fault = startFault(joint, start); !fault.empty()) fail(where, name + ": " + fault);
    if (const std::string warning = startWarning(joint, start); !warning.empty()) warn_(where, name + " " + warning);
  }
}

}  // namespace hl
