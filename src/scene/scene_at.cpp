#include "scene/scene_at.h"

#include <algorithm>
#include <limits>

#include "geometry/queries.h"
#include "scene/felt_order.h"

namespace hl {

namespace {

// Margin of a box for the rounding of its coordinates, as a fraction of the size of the scene.
constexpr double kBoxSlack = 1e-12;

Box around(const Vec3& from, const Vec3& to, double distance) {
  const Vec3 margin = Vec3::Constant(distance);
  return {from.cwiseMin(to) - margin, from.cwiseMax(to) + margin};
}

bool isEdge(const Primitive& primitive, Feature feature) {
  return primitive.kind == PrimitiveKind::kTriangle && feature >= Feature::kEdge0 && feature <= Feature::kEdge2;
}

// The index of an object at one moment. It adds up the cost of its queries.
class IndexAt final : public SpatialIndex {
 public:
  IndexAt(const Instance& instance, std::int64_t time_ns, QueryCost& cost)
      : resting_(*instance.shape->index), cost_(cost) {
    if (const MeshTransition* const way = instance.transitionAt(time_ns))
      moving_.emplace(way->index(way->part(time_ns), way->part(time_ns)));
  }
  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const override {
    return counted(now().overlap(centre, radius, visit));
  }
  std::size_t overlapUntil(const Vec3& centre, double radius, FunctionRef<bool(ElementId)> stop) const override {
    return counted(now().overlapUntil(centre, radius, stop));
  }
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId, double)> visit) const override {
    return counted(now().sweep(from, motion, radius, soon, visit));
  }
  std::size_t nearest(const Vec3& centre, double farthest,
                      FunctionRef<double(ElementId, double)> visit) const override {
    return counted(now().nearest(centre, farthest, visit));
  }
  IndexStats stats() const override { return now().stats(); }

 private:
  const SpatialIndex& now() const { return moving_ ? *moving_ : resting_; }
  std::size_t counted(std::size_t volumes) const {
    cost_.volumes += volumes;
    return volumes;
  }

  const SpatialIndex& resting_;
  std::optional<MovingBvh> moving_;
  QueryCost& cost_;
};

void toWorld(const Pose& pose, ClosestPoint& nearest) {
  nearest.point = pose.toWorld(nearest.point);
  nearest.normal = pose.turnToWorld(nearest.normal);
}

}  // namespace

SceneAt::SceneAt(const SceneAt& of, std::span<const std::uint64_t> left_out)
    : snapshot_(of.snapshot_), time_ns_(of.time_ns_), recent_(of.recent_), cost_(of.cost_) {
  for (const std::uint64_t key : left_out) {
    std::uint32_t number = 0;
    if (snapshot_.find(key, number)) left_out_.push(number);
  }
}

SceneAt::SceneAt(const SceneAt& of, std::int64_t time_ns)
    : snapshot_(of.snapshot_), time_ns_(time_ns), recent_(own_.emplace()), left_out_(of.left_out_), cost_(of.cost_) {}

Primitive SceneAt::read(PrimitiveId id) const {
  const Instance& of = instance(id);
  if (const MeshTransition* const way = of.transitionAt(time_ns_))
    return way->primitive(id.element, way->part(time_ns_));
  return of.shape->primitive(id.element);
}

Vec3 SceneAt::turnToObject(PrimitiveId id, const Vec3& v_W) const {
  return instance(id).atWorld() ? v_W : instance(id).poses().at(time_ns_).turnToObject(v_W);
}

Vec3 SceneAt::turnToWorld(PrimitiveId id, const Vec3& v_O) const {
  return instance(id).atWorld() ? v_O : instance(id).poses().at(time_ns_).turnToWorld(v_O);
}

ClosestPoint SceneAt::closest(PrimitiveId id, const Vec3& p) const {
  ClosestPoint nearest;
  closestWithin(id, p, std::numeric_limits<double>::infinity(), nearest);
  return nearest;
}

bool SceneAt::nearest(const Vec3& point, PrimitiveId& primitive, ClosestPoint& at) const {
  double limit = std::numeric_limits<double>::infinity();
  bool found = false;
  Box region = around(point, point, limit);
  const auto keep_nearer = [&](PrimitiveId asked) {
    ClosestPoint place;
    if (!closestWithin(asked, point, limit, place) || place.distance > limit) return;
    if (found && place.distance == limit && !precedes(asked, primitive)) return;
    found = true;
    primitive = asked;
    at = place;
    limit = place.distance;
    region = around(point, point, limit + kBoxSlack * snapshot_.extent);
  };
  snapshot_.near.visitMet(region, [&](std::uint32_t i) {
    const Instance& instance = snapshot_.instances[i];
    if (instance.elsewhere(region) || leavesOut(i)) return;
    const IndexAt index(instance, time_ns_, cost_);
    const Vec3 centre = instance.atWorld() ? point : instance.poses().at(time_ns_).toObject(point);
    index.nearest(centre, limit, [&](ElementId element, double) {
      keep_nearer({i, element});
      return limit;
    });
  });
  return found;
}

bool SceneAt::closestWithin(PrimitiveId id, const Vec3& p, double distance, ClosestPoint& out) const {
  const Primitive& asked = primitive(id);
  if (instance(id).atWorld()) return closestPointWithin(asked, p, distance, out);
  const Pose pose = instance(id).poses().at(time_ns_);
  if (!closestPointWithin(asked, pose.toObject(p), distance, out)) return false;
  toWorld(pose, out);
  return true;
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
  Primitive p = primitive(a), q = primitive(b);
  toOneFrame(instance(a), instance(b), time_ns_, p, q);
  if (!areCopies(p, q)) return hl::precedes(p, q);
  const int felt = compareFelt({instance(a), a.element, p}, {instance(b), b.element, q});
  if (felt != 0) return felt < 0;
  return a.instance != b.instance ? instance(a).key < instance(b).key : p.source < q.source;
}

// Calls search(index, read, centre_O, visit) for each object near the place, where visit(element, nearest_O) calls
// visit_one(primitive, nearest).
template <typename Search, typename Visit>
void SceneAt::searchNear(const Vec3& centre, double distance, const Search& search, const Visit& visit_one) const {
  const Box region = around(centre, centre, distance + kBoxSlack * snapshot_.extent);
  snapshot_.near.visitMet(region, [&](std::uint32_t i) {
    const Instance& instance = snapshot_.instances[i];
    if (instance.elsewhere(region) || leavesOut(i)) return;
    const IndexAt index(instance, time_ns_, cost_);
    const auto read_one = [&](ElementId element) -> const Primitive& { return primitive({i, element}); };
    if (instance.atWorld()) {
      search(index, read_one, centre, [&](ElementId element, const ClosestPoint& nearest) {
        return visit_one(PrimitiveId{i, element}, nearest);
      });
      return;
    }
    const Pose pose = instance.poses().at(time_ns_);
    search(index, read_one, pose.toObject(centre), [&](ElementId element, const ClosestPoint& nearest_O) {
      ClosestPoint nearest = nearest_O;
      toWorld(pose, nearest);
      return visit_one(PrimitiveId{i, element}, nearest);
    });
  });
}

void SceneAt::primitivesWithin(const Vec3& centre, double distance,
                               FunctionRef<void(PrimitiveId, const ClosestPoint&)> visit) const {
  const auto search = [&](const SpatialIndex& index, const auto& read_one, const Vec3& centre_O, const auto& each) {
    hl::primitivesWithin(index, read_one, centre_O, distance, each);
  };
  searchNear(centre, distance, search, visit);
}

bool SceneAt::fewWithin(const Vec3& centre, double distance, std::size_t most,
                        FunctionRef<void(PrimitiveId, const ClosestPoint&)> visit) const {
  std::size_t count = 0;
  const auto search = [&](const SpatialIndex& index, const auto& read_one, const Vec3& centre_O, const auto& each) {
    if (count <= most) hl::primitivesWithinUntil(index, read_one, centre_O, distance, each);
  };
  searchNear(centre, distance, search, [&](PrimitiveId primitive, const ClosestPoint& nearest) {
    if (++count > most) return true;
    visit(primitive, nearest);
    return false;
  });
  return count <= most;
}

namespace {

// Keeps the earlier of two impacts; at equal times that of the primitive that precedes(). `hit` is in the frame of its
// object. Returns whether `hit` was kept.
bool keepEarlier(const SceneAt& scene, const Impact& hit, PrimitiveId id, const Pose& pose, bool& found,
                 SceneImpact& out) {
  if (found && hit.t > out.impact.t) return false;
  if (found && hit.t == out.impact.t && !scene.precedes(id, out.primitive)) return false;
  found = true;
  out = {hit, id};
  if (!scene.instance(id).atWorld()) out.impact.normal = pose.turnToWorld(hit.normal);
  return true;
}

}  // namespace

// Calls ask(number, index, from_O, motion_O, hit) for each object near the way and keeps the earliest impact. After an
// impact is found, objects near only the rest of the way are skipped.
template <typename Ask>
bool SceneAt::firstOf(const Vec3& from, const Vec3& motion, double distance, const Ask& ask, SceneImpact& out) const {
  const double margin = distance + kBoxSlack * snapshot_.extent;
  Box region = around(from, from + motion, margin);
  bool found = false;
  snapshot_.near.visitMet(region, [&](std::uint32_t i) {
    const Instance& instance = snapshot_.instances[i];
    if (instance.elsewhere(region) || leavesOut(i)) return;
    const bool at_world = instance.atWorld();
    const Pose pose = at_world ? Pose{} : instance.poses().at(time_ns_);
    const Vec3 from_O = at_world ? from : pose.toObject(from);
    const Vec3 motion_O = at_world ? motion : pose.turnToObject(motion);
    FirstImpact hit;
    const IndexAt index(instance, time_ns_, cost_);
    if (!ask(i, index, from_O, motion_O, hit)) return;
    if (!keepEarlier(*this, hit.impact, {i, hit.primitive}, pose, found, out)) return;
    region = around(from, from + hit.impact.t * motion, margin);
  });
  return found;
}

bool SceneAt::firstImpact(const Vec3& from, const Vec3& motion, double radius, double touching,
                          SceneImpact& out) const {
  const auto is_contact = [&](const ClosestPoint& start) { return touching > 0 && start.distance <= touching; };
  return firstImpact(from, motion, radius, is_contact, out);
}

bool SceneAt::firstImpact(const Vec3& from, const Vec3& motion, double radius,
                          FunctionRef<bool(const ClosestPoint&)> is_contact, SceneImpact& out) const {
  const auto ask = [&](std::uint32_t i, const SpatialIndex& index, const Vec3& from_O, const Vec3& motion_O,
                       FirstImpact& hit) {
    const auto read_one = [&](ElementId element) -> const Primitive& { return primitive({i, element}); };
    const Instance& of = instance({i, 0});
    const auto is_contact_O = [&](ClosestPoint start) {
      if (!of.atWorld()) toWorld(of.poses().at(time_ns_), start);
      return is_contact(start);
    };
    return hl::firstImpact(index, read_one, from_O, motion_O, radius, is_contact_O, hit);
  };
  return firstOf(from, motion, radius, ask, out);
}

bool SceneAt::firstImpact(const Vec3& from, const Vec3& motion, double radius, double touching, double soon,
                          std::span<const PrimitiveId> contacts, FunctionRef<void(PrimitiveId)> meet,
                          SceneImpact& out) const {
  const auto ask = [&](std::uint32_t i, const SpatialIndex& index, const Vec3& from_O, const Vec3& motion_O,
                       FirstImpact& hit) {
    const auto is_contact = [&](ElementId element) {
      return std::find(contacts.begin(), contacts.end(), PrimitiveId{i, element}) != contacts.end();
    };
    const auto met = [&](ElementId element) { meet({i, element}); };
    const auto read_one = [&](ElementId element) -> const Primitive& { return primitive({i, element}); };
    return hl::firstImpact(index, read_one, from_O, motion_O, radius, touching, soon, is_contact, met, hit);
  };
  return firstOf(from, motion, touching, ask, out);
}

bool SceneAt::firstImpactAmong(std::span<const PrimitiveId> primitives, const Vec3& from, const Vec3& motion,
                               double radius, SceneImpact& out) const {
  bool found = false;
  for (const PrimitiveId id : primitives) {
    const bool at_world = instance(id).atWorld();
    const Pose pose = at_world ? Pose{} : instance(id).poses().at(time_ns_);
    const Vec3 from_O = at_world ? from : pose.toObject(from);
    const Vec3 motion_O = at_world ? motion : pose.turnToObject(motion);
    Impact impact;
    if (!sweepSphereFromOutside(primitive(id), from_O, motion_O, radius, found ? out.impact.t : 1, impact)) continue;
    keepEarlier(*this, impact, id, pose, found, out);
  }
  return found;
}

}  // namespace hl
