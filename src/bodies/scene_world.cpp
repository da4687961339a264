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
std::string coverWarning(const Instance& instance) {
  if (!instance.movesAsBody() || instance.body->spec.shape != BodyShape::kParts) return {};
  const std::shared_ptr<const Body> made =
      named(instance, [&] { return madeBody(instance.shape, instance.body->spec); });
  const double size_m = instance.shape->model.bounds().size().norm() / 2;
  const double off_m = std::max(made->hull_error_m, made->excess_m);
  if (!(off_m > kNearlyConvex * size_m)) return {};
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      ": its %zu parts are up to %.3g mm off its mesh, %.2g %% of its size, not %.2g %%: draw it simpler, or of "
      "convex pieces",
      made->shape.parts.size(), 1e3 * off_m, 100 * off_m / size_m, 100 * kNearlyConvex);
  return instance.body->name + text.data();
}

}  // namespace

std::vector<std::string> coverWarnings(const Snapshot& snapshot) {
  std::vector<std::string> warnings;
  std::set<const Shape*> warned;
  for (const Instance& instance : snapshot.instances) {
    const std::string warning = coverWarning(instance);
    if (!warning.empty() && warned.insert(instance.shape.get()).second) warnings.push_back(warning);
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
