// The two exact queries of the proxy, the same for every SpatialIndex: the first impact, and the primitives within a
// distance.
#pragma once

#include <cstdint>

#include "base/function_ref.h"
#include "geometry/closest_point.h"
#include "geometry/primitives.h"
#include "geometry/spatial_index.h"
#include "geometry/sweep.h"

namespace hl {

/// Valid only when firstImpact returned true.
struct FirstImpact {
  Impact impact;
  ElementId primitive = 0;
};

/// Whether `a` comes before `b`: by their vertices, lexicographically; copies are ordered by kind and source. The order
/// in the input does not matter otherwise. RT-safe.
bool precedes(const Primitive& a, const Primitive& b);

/// First impact of a sphere of `radius` moving from `from` by `motion`, over all primitives except the caller's
/// contacts: those with closestPoint(from).distance <= `touching` (m); 0 or less skips none. The result does not depend
/// on the index or on the order of the primitives: at equal times precedes() decides. Returns false, and leaves `out`
/// unchanged, if there is no impact. RT-safe, any thread.
bool firstImpact(const SpatialIndex& index, const Primitives& primitives, const Vec3& from, const Vec3& motion,
                 double radius, double touching, FirstImpact& out);

/// The same, with a function that reads primitives.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read, const Vec3& from,
                 const Vec3& motion, double radius, double touching, FirstImpact& out);
/// The same over all primitives except those for which is_contact(point nearest to `from`) is true.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read, const Vec3& from,
                 const Vec3& motion, double radius, FunctionRef<bool(const ClosestPoint& start)> is_contact,
                 FirstImpact& out);
/// The same for known contacts: `is_contact` returns whether a primitive is within `touching` (> `radius`) of `from`.
/// Calls `meet`, in no given order and possibly repeatedly, for a set of primitives. The set includes all within
/// `touching` of the position at which the motion ends or is stopped, even if rounding moves this position a little.
/// `soon` as in SpatialIndex::sweep.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read, const Vec3& from,
                 const Vec3& motion, double radius, double touching, double soon,
                 FunctionRef<bool(ElementId primitive)> is_contact, FunctionRef<void(ElementId primitive)> meet,
                 FirstImpact& out);

/// Visits exactly the primitives within `distance` (m, inclusive) of `centre`, in no given order, possibly more than
/// once. RT-safe, any thread.
void primitivesWithin(const SpatialIndex& index, const Primitives& primitives, const Vec3& centre, double distance,
                      FunctionRef<void(ElementId primitive, const ClosestPoint& nearest)> visit);
/// The same, with a function that reads primitives.
void primitivesWithin(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read,
                      const Vec3& centre, double distance,
                      FunctionRef<void(ElementId primitive, const ClosestPoint& nearest)> visit);
/// The same until `stop` returns true.
void primitivesWithinUntil(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read,
                           const Vec3& centre, double distance,
                           FunctionRef<bool(ElementId primitive, const ClosestPoint& nearest)> stop);

}  // namespace hl
