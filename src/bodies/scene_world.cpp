#include "bodies/scene_world.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <utility>

#include "base/error.h"
#include "bodies/joint_check.h"
#include "bodies/joint_start.h"
#include "bodies/made_bodies.h"
#include "bodies/mesh_parts.h"

namespace hl {

namespace {

// Of a body of the scene: what is wrong with it is reported with its name.
template <typename Make>
auto named(const Instance& instance, Make make) {
  try {
    return make();
  } catch (const Error& error) {
    throw Error(instance.body->name + ": " + error.what());
  }
}

}  // namespace

std::size_t partsIn(const Snapshot& snapshot) {
  std::size_t parts = 0;
  for (const Instance& instance : snapshot.instances) {
    if (instance.movesAsBody())
      parts += named(instance, [&] { return madeBody(instance.shape, instance.body->spec)->shape.parts.size(); });
  }
  return parts;
}

namespace {

// Empty: the parts of the body are as near to its mesh as they should be.
std::string coverWarning(const Body& made, double size_m) {
  const double off_m = std::max(made.hull_error_m, made.excess_m);
  if (!(off_m > kNearlyConvex * size_m)) return {};
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "its %zu parts are up to %.3g mm off its mesh, %.2g %% of its size, not %.2g %%: draw it simpler, or of "
      "convex pieces",
      made.shape.parts.size(), 1e3 * off_m, 100 * off_m / size_m, 100 * kNearlyConvex);
  return text.data();
}

// Empty: its mesh is closed.
std::string openWarning(const Body& made, bool has_mass) {
  if (made.open_edges == 0) return {};
  const char* mass = has_mass ? "" : "set its mass (massKg), or ";
  std::array<char, 240> text{};
  if (made.shell_m > 0) {
    std::snprintf(text.data(), text.size(),
                  "its mesh is open at %zu edges and counts as a shell, %.3g mm thick, of %.4g kg: %sclose the mesh, "
                  "or draw its walls with a thickness",
                  made.open_edges, 1e3 * made.shell_m, made.mass.mass_kg, mass);
  } else {
    std::snprintf(
        text.data(), text.size(),
        "its mesh is open at %zu edges and counts as a solid with its holes closed, of %.4g kg: %sclose the mesh",
        made.open_edges, made.mass.mass_kg, mass);
  }
  return text.data();
}

}  // namespace

std::vector<std::string> partsWarnings(const std::shared_ptr<const Shape>& shape, const BodySpec& spec) {
  std::vector<std::string> warnings;
  if (spec.fixed || spec.shape != BodyShape::kParts) return warnings;
  const std::shared_ptr<const Body> made = madeBody(shape, spec);
  for (const std::string& warning :
       {openWarning(*made, spec.mass_kg.has_value()), coverWarning(*made, shape->model.bounds().size().norm() / 2)}) {
    if (!warning.empty()) warnings.push_back(warning);
  }
  return warnings;
}

std::vector<std::string> bodyWarnings(const Snapshot& snapshot) {
  std::vector<std::string> warnings;
  std::set<const Shape*> warned;
  for (const Instance& instance : snapshot.instances) {
    if (!instance.movesAsBody()) continue;
    const auto of_body = named(instance, [&] { return partsWarnings(instance.shape, instance.body->spec); });
    if (of_body.empty() || !warned.insert(instance.shape.get()).second) continue;
    for (const std::string& warning : of_body) warnings.push_back(instance.body->name + ": " + warning);
  }
  return warnings;
}

namespace {

Pose startOf(const Snapshot& snapshot, std::uint64_t key) {
  for (const Instance& instance : snapshot.instances) {
    if (instance.key == key && instance.movesAsBody()) return instance.body->start;
  }
  return {};
}

void addJoints(const Snapshot& snapshot, World& world) {
  std::uint64_t place = 0;
  const auto start = [&](std::uint64_t key) {
    return world.has(key) ? std::optional(startOf(snapshot, key)) : std::nullopt;
  };
  for (JointSpec spec : snapshot.mechanics.joints) {
    ++place;
    if (spec.key == 0) spec.key = place;
    const std::optional<Joint> joint = steppedJoint(spec, start);
    if (!joint) continue;
    world.joints.push_back(*joint);
    try {
      checkJoint(world.joints.back(), [&](std::uint64_t number) { return world.has(number); });
    } catch (const Error& error) {
      throw Error(spec.name + ": " + error.what());
    }
  }
  std::sort(world.joints.begin(), world.joints.end(), [](const Joint& x, const Joint& y) { return x.key < y.key; });
}

}  // namespace

std::shared_ptr<const World> worldOf(const Snapshot& snapshot) {
  auto world = std::make_shared<World>();
  std::vector<Instance> fixed;
  std::size_t parts = 0;
  for (const Instance& instance : snapshot.instances) {
    if (!instance.movesAsBody()) {
      fixed.push_back(instance);
      world->fixed_surfaces.push_back(instance.body ? std::optional(instance.body->spec.surface) : std::nullopt);
      continue;
    }
    world->bodies.push_back(named(instance, [&] { return *madeBody(instance.shape, instance.body->spec); }));
    world->bodies.back().key = instance.key;
    parts += world->bodies.back().shape.parts.size();
  }
  if (world->bodies.empty()) return nullptr;
  if (parts > kMaxBodies)
    throw Error("its bodies have " + std::to_string(parts) + " parts, and at most " + std::to_string(kMaxBodies) +
                " can move");
  if (!fixed.empty()) world->fixed = makeSnapshot(std::move(fixed));
  world->gravity_m_s2 = snapshot.mechanics.gravity_m_s2;
  addJoints(snapshot, *world);
  return world;
}

}  // namespace hl
