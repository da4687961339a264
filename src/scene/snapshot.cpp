#include "scene/snapshot.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <utility>

#include "scene/by_key.h"

namespace hl {

namespace {

// Bounds of all shapes of the mesh motion: during a transition a mesh stays within the bounds of its two ends.
Box objectBox(const Instance& instance) {
  Box box = instance.shape->bounds;
  if (instance.mesh_motion) instance.mesh_motion->forEachShape([&](const auto& shape) { box.extend(shape->bounds); });
  return box;
}

Box reachOf(const Instance& instance) {
  const Box object = objectBox(instance);
  if (object.empty()) return object;
  return instance.poses().reach(object);
}

Pose finalPose(const Instance& instance) {
  return instance.movesAsBody() ? instance.body->poses->shown().pose : instance.poses().to();
}

double largestCoordinate(const Box& box) {
  return box.empty() ? 0 : box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
}

// Each instance is moved once, or not at all if they are sorted already, as those of one client are.
std::vector<Instance> byKey(std::vector<Instance> instances) {
  const auto before = [](const Instance& a, const Instance& b) { return a.key < b.key; };
  if (std::is_sorted(instances.begin(), instances.end(), before)) return instances;
  std::vector<Instance> sorted;
  sorted.reserve(instances.size());
  for (Instance* instance : pointersByKey(instances)) sorted.push_back(std::move(*instance));
  return sorted;
}

bool allDefault(const std::vector<Material>& materials) {
  return std::all_of(materials.begin(), materials.end(), [](const Material& one) { return one == Material{}; });
}

// Of the snaps or fields of all instances, as many as may count, with so many points.
template <typename Placed, typename List>
std::vector<Placed> firstOf(const std::vector<Instance>& instances, std::shared_ptr<const List> Instance::*lists,
                            std::size_t most) {
  std::vector<Placed> all;
  std::size_t points = 0;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    const List* const list = (instances[i].*lists).get();
    for (std::uint32_t number = 0; list != nullptr && number < list->size(); ++number) {
      points += (*list)[number].points.size();
      if (all.size() == most || points > kMaxSnapPoints) return all;
      all.push_back({i, number});
    }
  }
  return all;
}

// Those whose matter hinders a motion are kept first: a hand feels them without a touch.
void keepMostMatter(Snapshot& snapshot) {
  snapshot.matter = snapshot.all_matter;
  if (snapshot.matter.size() <= kMaxMatter) return;
  std::stable_partition(snapshot.matter.begin(), snapshot.matter.end(),
                        [&](std::uint32_t number) { return snapshot.instances[number].shape->source->resists(); });
  snapshot.matter.resize(kMaxMatter);
}

bool knowsMatter(const Shape& shape) { return shape.source && shape.source->siteOf(Vec3::Zero()) != Site::kUnknown; }

// Of the instance that gets the next number: where those are to be found that not each query asks.
void addToLists(const Instance& instance, Snapshot& snapshot) {
  const auto number = static_cast<std::uint32_t>(snapshot.reach.size());
  if (instance.mesh_motion) {
    snapshot.deforming.push_back(number);
    snapshot.deforms_until_ns = std::max(snapshot.deforms_until_ns, instance.mesh_motion->end_ns());
  }
  if (instance.poses().moves()) {
    snapshot.moving.push_back(number);
    snapshot.moves_until_ns = std::max(snapshot.moves_until_ns, instance.poses().restsFrom_ns());
  }
  if (knowsMatter(*instance.shape)) snapshot.all_matter.push_back(number);
}

}  // namespace

std::shared_ptr<const Surfaces> surfacesOf(const std::shared_ptr<const Shape>& shape) {
  auto surfaces = std::make_shared<Surfaces>();
  surfaces->materials = shape->model.materials;
  for (const Texture& texture : shape->model.textures) surfaces->textures.emplace_back(shape, &texture);
  return surfaces;
}

void setBody(Instance& instance, std::shared_ptr<const RigidBody> body) {
  instance.motion = Motion(body->start);
  instance.driver = body->poses;
  instance.body = std::move(body);
}

std::size_t movingBodies(const Snapshot& snapshot) {
  const auto moves = [](const Instance& instance) { return instance.movesAsBody(); };
  return static_cast<std::size_t>(std::count_if(snapshot.instances.begin(), snapshot.instances.end(), moves));
}

std::size_t memoryOf(const Snapshot& snapshot) {
  std::set<const void*> counted;
  std::size_t bytes = snapshot.instances.capacity() * sizeof(Instance) + snapshot.reach.capacity() * sizeof(Box) +
                      (snapshot.moving.capacity() + snapshot.deforming.capacity() + snapshot.matter.capacity() +
                       snapshot.all_matter.capacity()) *
                          sizeof(std::uint32_t) +
                      snapshot.near.bytes();
  for (const Instance& instance : snapshot.instances) {
    const auto add = [&](const std::shared_ptr<const Shape>& shape) {
      if (counted.insert(shape.get()).second) bytes += shape->bytes();
      if (const SharedMemory shared = shape->shared(); counted.insert(shared.of).second) bytes += shared.bytes;
    };
    add(instance.shape);
    if (instance.mesh_motion) instance.mesh_motion->forEachShape(add);
    for (const auto& texture : instance.surfaces->textures) {
      if (counted.insert(texture.get()).second) bytes += texture->texels.capacity() * sizeof(texture->texels[0]);
    }
  }
  return bytes;
}

bool Snapshot::find(std::uint64_t key, std::uint32_t& index) const {
  const auto found = std::lower_bound(instances.begin(), instances.end(), key,
                                      [](const Instance& one, std::uint64_t wanted) { return one.key < wanted; });
  if (found == instances.end() || found->key != key) return false;
  index = static_cast<std::uint32_t>(found - instances.begin());
  return true;
}

std::shared_ptr<const Snapshot> makeSnapshot(std::vector<Instance> instances, std::string name, std::uint64_t number,
                                             std::int64_t blend_ns, const Mechanics& mechanics) {
  static std::atomic<std::uint64_t> made{0};
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->identity = ++made;
  snapshot->name = std::move(name);
  snapshot->number = number;
  snapshot->blend_ns = blend_ns;
  snapshot->mechanics = mechanics;
  snapshot->instances = byKey(std::move(instances));
  for (Instance& instance : snapshot->instances) {
    instance.plain = allDefault(instance.surfaces->materials);
    addToLists(instance, *snapshot);
    snapshot->reach.push_back(reachOf(instance));
    const Box rest = boxAt(instance.shape->bounds, finalPose(instance));
    if (!rest.empty()) {
      snapshot->bounds.extend(rest.min);
      snapshot->bounds.extend(rest.max);
    }
    snapshot->extent =
        std::max({snapshot->extent, largestCoordinate(objectBox(instance)), largestCoordinate(snapshot->reach.back())});
    snapshot->primitives += instance.shape->elements();
  }
  snapshot->moves_until_ns = std::max(snapshot->moves_until_ns, snapshot->deforms_until_ns);
  keepMostMatter(*snapshot);
  snapshot->near = BoxTree(snapshot->reach);
  snapshot->snaps = firstOf<PlacedSnap>(snapshot->instances, &Instance::snaps, kMaxSnaps);
  snapshot->fields = firstOf<PlacedField>(snapshot->instances, &Instance::fields, kMaxFields);
  return snapshot;
}

std::shared_ptr<const Snapshot> makeSnapshot(Model model, HierarchyKind hierarchy) {
  Instance instance;
  std::string name = model.name;
  instance.shape = makeShape(std::move(model), hierarchy);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  auto snapshot = std::make_shared<Snapshot>(*makeSnapshot({std::move(instance)}, std::move(name)));
  snapshot->warnings = snapshot->shape().warnings;
  return snapshot;
}

}  // namespace hl
