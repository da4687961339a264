#include "scene/snapshot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hl {

namespace {

void addSphere(Box& box, const Vec3& centre, double radius) {
  box.extend(centre - Vec3::Constant(radius));
  box.extend(centre + Vec3::Constant(radius));
}

Box boxAt(const Box& object, const Pose& pose) {
  if (pose == Pose{}) return object;
  const Vec3 centre = pose.toWorld(object.centre());
  const Vec3 half = pose.rotation.cwiseAbs() * (0.5 * object.size());
  Box box;
  box.extend(centre - half);
  box.extend(centre + half);
  return box;
}

// While it moves: the sphere about its box moves with a centre that strays from its two ends by no more than their
// distance, as a turn is at most half a circle and the axis of a screw is straight.
Box reachOf(const Instance& instance) {
  const Box& object = instance.shape->bounds;
  if (object.empty()) return object;
  if (!instance.motion.moves()) return boxAt(object, instance.motion.to());
  const Vec3 begin = instance.motion.from().toWorld(object.centre());
  const Vec3 end = instance.motion.to().toWorld(object.centre());
  const double radius = 0.5 * object.size().norm() + (instance.motion.angle() > 0 ? (end - begin).norm() : 0.0);
  Box box;
  addSphere(box, begin, radius);
  addSphere(box, end, radius);
  return box;
}

double largestCoordinate(const Box& box) {
  return box.empty() ? 0 : box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
}

}  // namespace

std::shared_ptr<const Surfaces> surfacesOf(const std::shared_ptr<const Shape>& shape) {
  auto surfaces = std::make_shared<Surfaces>();
  surfaces->materials = shape->model.materials;
  for (const Texture& texture : shape->model.textures) surfaces->textures.emplace_back(shape, &texture);
  return surfaces;
}

std::shared_ptr<const Snapshot> makeSnapshot(std::vector<Instance> instances, std::string name) {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->name = std::move(name);
  snapshot->instances = std::move(instances);
  std::sort(snapshot->instances.begin(), snapshot->instances.end(),
            [](const Instance& a, const Instance& b) { return a.key < b.key; });
  for (Instance& instance : snapshot->instances) {
    instance.reach = reachOf(instance);
    const Box rest = boxAt(instance.shape->bounds, instance.motion.to());
    if (!rest.empty()) {
      snapshot->bounds.extend(rest.min);
      snapshot->bounds.extend(rest.max);
    }
    snapshot->extent = std::max({snapshot->extent, instance.shape->extent, largestCoordinate(instance.reach)});
    snapshot->primitives += instance.shape->primitives.size();
  }
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
