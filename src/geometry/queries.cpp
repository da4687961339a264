#include "geometry/queries.h"

#include <algorithm>
#include <array>

namespace hl {

namespace {

// -1, 0 or 1: order of two primitives by their vertices, so that no answer depends on the order they came in.
int compareVertices(const Primitive& a, const Primitive& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (a.vertex[i][axis] != b.vertex[i][axis]) return a.vertex[i][axis] < b.vertex[i][axis] ? -1 : 1;
    }
  }
  return 0;
}

// The last few primitives tested: an index that covers a primitive with many leaves proposes it many times in
// succession.
class RecentlySeen {
 public:
  bool testAndAdd(ElementId primitive) {
    if (std::find(seen_.begin(), seen_.end(), primitive) != seen_.end()) return true;
    seen_[next_++ % seen_.size()] = primitive;
    return false;
  }

 private:
  static constexpr ElementId kNone = ~ElementId{0};
  std::array<ElementId, 4> seen_{kNone, kNone, kNone, kNone};
  std::size_t next_ = 0;
};

// Default for `soon`: a sphere that starts near a surface usually hits within this distance.
constexpr double kSoonPerRadius = 0.25;

// The earliest impact returned by impact_of() among the primitives that the index proposes for a sphere of radius
// `proposed`.
template <typename Read, typename ImpactOf>
bool firstOf(const SpatialIndex& index, const Read& read, const Vec3& from, const Vec3& motion, double proposed,
             double soon, const ImpactOf& impact_of, FirstImpact& out) {
  bool found = false;
  RecentlySeen seen;
  index.sweep(from, motion, proposed, soon, [&](ElementId candidate, double limit) {
    Impact impact;
    if (seen.testAndAdd(candidate) || !impact_of(candidate, found ? out.impact.t : 1, impact)) return limit;
    if (found) {
      if (impact.t > out.impact.t) return limit;
      if (impact.t == out.impact.t) {
        const Primitive first = read(out.primitive);  // NOLINT: a copy, as read() may reuse its result
        if (!precedes(read(candidate), first)) return limit;
      }
    }
    found = true;
    out = FirstImpact{impact, candidate};
    return impact.t;
  });
  return found;
}

}  // namespace

bool precedes(const Primitive& a, const Primitive& b) {
  const int order = compareVertices(a, b);
  if (order != 0) return order < 0;
  if (a.kind != b.kind) return a.kind < b.kind;
  return a.source < b.source;
}

bool firstImpact(const SpatialIndex& index, const Primitives& primitives, const Vec3& from, const Vec3& motion,
                 double radius, double touching, FirstImpact& out) {
  Primitive last;
  const auto read = [&](ElementId candidate) -> const Primitive& { return last = primitives[candidate]; };
  return firstImpact(index, read, from, motion, radius, touching, out);
}

bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId)> read, const Vec3& from,
                 const Vec3& motion, double radius, double touching, FirstImpact& out) {
  const auto is_contact = [&](const ClosestPoint& start) { return touching > 0 && start.distance <= touching; };
  return firstImpact(index, read, from, motion, radius, is_contact, out);
}

bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId)> read, const Vec3& from,
                 const Vec3& motion, double radius, FunctionRef<bool(const ClosestPoint&)> is_contact,
                 FirstImpact& out) {
  const auto impact_of = [&](ElementId candidate, double, Impact& impact) {
    const Primitive& primitive = read(candidate);
    const ClosestPoint start = closestPoint(primitive, from);
    return !is_contact(start) && sweepSphere(primitive, start, from, motion, radius, impact);
  };
  return firstOf(index, read, from, motion, radius, kSoonPerRadius * radius, impact_of, out);
}

// A primitive within `touching` at the end of the way is proposed even if rounding moves the end, as it is within a
// slightly larger distance before the end.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId)> read, const Vec3& from,
                 const Vec3& motion, double radius, double touching, double soon,
                 FunctionRef<bool(ElementId)> is_contact, FunctionRef<void(ElementId)> meet, FirstImpact& out) {
  const double proposed = touching + (touching - radius);
  const auto impact_of = [&](ElementId candidate, double latest, Impact& impact) {
    meet(candidate);
    return !is_contact(candidate) && sweepSphereFromOutside(read(candidate), from, motion, radius, latest, impact);
  };
  return firstOf(index, read, from, motion, proposed, soon, impact_of, out);
}

void primitivesWithin(const SpatialIndex& index, const Primitives& primitives, const Vec3& centre, double distance,
                      FunctionRef<void(ElementId, const ClosestPoint&)> visit) {
  Primitive last;
  const auto read = [&](ElementId candidate) -> const Primitive& { return last = primitives[candidate]; };
  primitivesWithin(index, read, centre, distance, visit);
}

void primitivesWithin(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId)> read, const Vec3& centre,
                      double distance, FunctionRef<void(ElementId, const ClosestPoint&)> visit) {
  const auto visit_all = [&](ElementId primitive, const ClosestPoint& nearest) {
    visit(primitive, nearest);
    return false;
  };
  primitivesWithinUntil(index, read, centre, distance, visit_all);
}

void primitivesWithinUntil(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId)> read, const Vec3& centre,
                           double distance, FunctionRef<bool(ElementId, const ClosestPoint&)> stop) {
  RecentlySeen seen;
  index.overlapUntil(centre, distance, [&](ElementId candidate) {
    if (seen.testAndAdd(candidate)) return false;
    const ClosestPoint nearest = closestPoint(read(candidate), centre);
    return nearest.distance <= distance && stop(candidate, nearest);
  });
}

}  // namespace hl
