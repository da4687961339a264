// The two exact questions of the proxy, the same for every SpatialIndex: what is hit first, and what is near.
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

/// Whether `a` comes before `b`: by their vertices, lexicographically; copies are distinguished by their source.
/// The order in which primitives were given decides nothing. RT-safe.
bool precedes(const Primitive& a, const Primitive& b);

/// First impact of a sphere of `radius` moving from `from` by `motion`, over all primitives but those whose
/// closestPoint(from).distance <= `touching` (m): they are the caller's contacts; pass 0 or less to skip none. The
/// result does not depend on the index or on the order of the primitives: equal times are decided by the vertices,
/// lexicographically. Returns false, and leaves `out` alone, for no impact. RT-safe, any thread.
bool firstImpact(const SpatialIndex& index, const Primitives& primitives, const Vec3& from, const Vec3& motion,
                 double radius, double touching, FirstImpact& out);

/// The same for a caller who reads primitives in its own way.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read, const Vec3& from,
                 const Vec3& motion, double radius, double touching, FirstImpact& out);
/// The same over all primitives but those of which `is_contact` says so, given the point nearest to `from`.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read, const Vec3& from,
                 const Vec3& motion, double radius, FunctionRef<bool(const ClosestPoint& start)> is_contact,
                 FirstImpact& out);
/// The same for a caller who reads primitives in its own way and knows its contacts: `is_contact` says of a primitive
/// whether it is within `touching`, which is more than `radius`, of `from`. Calls `meet` for some primitives (one maybe
/// more than once), in no given order, among which is every one within `touching` of the place where the motion ends or
/// is stopped, and of any place that rounding puts a little aside. `soon` as in SpatialIndex::sweep.
bool firstImpact(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read, const Vec3& from,
                 const Vec3& motion, double radius, double touching, double soon,
                 FunctionRef<bool(ElementId primitive)> is_contact, FunctionRef<void(ElementId primitive)> meet,
                 FirstImpact& out);

/// Visits every primitive within `distance` (m, inclusive) of `centre`, exactly; may repeat one, in no given order.
/// RT-safe, any thread.
void primitivesWithin(const SpatialIndex& index, const Primitives& primitives, const Vec3& centre, double distance,
                      FunctionRef<void(ElementId primitive, const ClosestPoint& nearest)> visit);
/// The same for a caller who reads primitives in its own way.
void primitivesWithin(const SpatialIndex& index, FunctionRef<const Primitive&(ElementId primitive)> read,
                      const Vec3& centre, double distance,
                      FunctionRef<void(ElementId primitive, const ClosestPoint& nearest)> visit);

}  // namespace hl
