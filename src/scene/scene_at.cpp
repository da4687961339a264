#include "scene/scene_at.h"

#include <algorithm>

#include "geometry/queries.h"

namespace hl {

namespace {

// A box answers for the rounding of the coordinates it was made from by this part of the scene's size.
constexpr double kBoxSlack = 1e-12;

struct Region {
  Vec3 min, max;
};

bool apart(const Box& box, const Region& region) {
  return (box.min.array() > region.max.array()).any() || (box.max.array() < region.min.array()).any();
}

bool isEdge(const Primitive& primitive, Feature feature) {
  return primitive.kind == PrimitiveKind::kTriangle && feature >= Feature::kEdge0 && feature <= Feature::kEdge2;
}

void toWorld(const Pose& pose, ClosestPoint& nearest) {
  nearest.point = pose.toWorld(nearest.point);
  nearest.normal = pose.turnToWorld(nearest.normal);
}

}  // namespace

Vec3 SceneAt::turnToObject(PrimitiveId id, const Vec3& v_W) const {
  const Motion& motion = instance(id).motion;
  return motion.identity() ? v_W : motion.at(time_ns_).turnToObject(v_W);
}

Vec3 SceneAt::turnToWorld(PrimitiveId id, const Vec3& v_O) const {
  const Motion& motion = instance(id).motion;
  return motion.identity() ? v_O : motion.at(time_ns_).turnToWorld(v_O);
}

ClosestPoint SceneAt::closest(PrimitiveId id, const Vec3& p) const {
  const Motion& motion = instance(id).motion;
  if (motion.identity()) return closestPoint(primitive(id), p);
  const Pose pose = motion.at(time_ns_);
  ClosestPoint nearest = closestPoint(primitive(id), pose.toObject(p));
  toWorld(pose, nearest);
  return nearest;
}

// Edge i is opposite vertex i, and a segment's only edge joins vertices 0 and 1.
Vec3 SceneAt::edge(PrimitiveId id, Feature feature) const {
  const Primitive& p = primitive(id);
  std::size_t from = 0, to = 1;
  if (isEdge(p, feature)) {
    const auto opposite = static_cast<std::size_t>(feature) - static_cast<std::size_t>(Feature::kEdge0);
    from = (opposite + 1) % 3;
    to = (opposite + 2) % 3;
  }
  return turnToWorld(id, (p.vertex[to] - p.vertex[from]).normalized());
}

bool SceneAt::precedes(PrimitiveId a, PrimitiveId b) const {
  if (a.instance == b.instance) return hl::precedes(primitive(a), primitive(b));
  Primitive p = primitive(a), q = primitive(b);
  const Pose pose_a = instance(a).motion.at(time_ns_), pose_b = instance(b).motion.at(time_ns_);
  for (std::size_t i = 0; i < 3; ++i) {
    p.vertex[i] = pose_a.toWorld(p.vertex[i]);
    q.vertex[i] = pose_b.toWorld(q.vertex[i]);
  }
  if (hl::precedes(p, q)) return true;
  return !hl::precedes(q, p) && instance(a).key < instance(b).key;
}

void SceneAt::primitivesWithin(const Vec3& centre, double distance,
                               FunctionRef<void(PrimitiveId, const ClosestPoint&)> visit) const {
  const Vec3 margin = Vec3::Constant(distance + kBoxSlack * snapshot_.extent);
  const Region region{centre - margin, centre + margin};
  for (std::uint32_t i = 0; i < snapshot_.instances.size(); ++i) {
    if (apart(snapshot_.reach[i], region)) continue;
    const Instance& instance = snapshot_.instances[i];
    const Shape& shape = *instance.shape;
    if (instance.motion.identity()) {
      hl::primitivesWithin(*shape.index, shape.primitives, centre, distance,
                           [&](std::uint32_t element, const ClosestPoint& nearest) {
                             visit({i, element}, nearest);
                           });
      continue;
    }
    const Pose pose = instance.motion.at(time_ns_);
    hl::primitivesWithin(*shape.index, shape.primitives, pose.toObject(centre), distance,
                         [&](std::uint32_t element, const ClosestPoint& nearest_O) {
                           ClosestPoint nearest = nearest_O;
                           toWorld(pose, nearest);
                           visit({i, element}, nearest);
                         });
  }
}

bool SceneAt::firstImpact(const Vec3& from, const Vec3& motion, double radius, double touching,
                          SceneImpact& out) const {
  const Vec3 margin = Vec3::Constant(radius + kBoxSlack * snapshot_.extent);
  const Vec3 end = from + motion;
  const Region region{from.cwiseMin(end) - margin, from.cwiseMax(end) + margin};
  bool found = false;
  for (std::uint32_t i = 0; i < snapshot_.instances.size(); ++i) {
    if (apart(snapshot_.reach[i], region)) continue;
    const Instance& instance = snapshot_.instances[i];
    const Shape& shape = *instance.shape;
    const Pose pose = instance.motion.identity() ? Pose{} : instance.motion.at(time_ns_);
    const Vec3 from_O = instance.motion.identity() ? from : pose.toObject(from);
    const Vec3 motion_O = instance.motion.identity() ? motion : pose.turnToObject(motion);
    FirstImpact hit;
    if (!hl::firstImpact(*shape.index, shape.primitives, from_O, motion_O, radius, touching, hit)) continue;
    const PrimitiveId id{i, hit.primitive};
    if (found && hit.impact.t > out.impact.t) continue;
    if (found && hit.impact.t == out.impact.t && !precedes(id, out.primitive)) continue;
    found = true;
    out = {hit.impact, id};
    if (!instance.motion.identity()) out.impact.normal = pose.turnToWorld(hit.impact.normal);
  }
  return found;
}

}  // namespace hl
