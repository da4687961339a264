// Manifold: where two convex shapes touch, or are about to: one normal, and the points that bear the load.
//
// Polyhedra are compared by the separating axis theorem, and the touching faces are clipped against each other: C.
// Ericson, Real-Time Collision Detection, 2005, sections 5.2 and 8.3. Apart, where no faces overlap, the two closest
// points decide.
#pragma once

#include "base/fixed_vector.h"
#include "bodies/placed_convex.h"

namespace hl {

struct ManifoldPoint {
  Vec3 point = Vec3::Zero();  ///< m, world, halfway between the shapes
  double gap = 0;             ///< m along the normal; < 0: they overlap
};

struct Manifold {
  static constexpr std::size_t kMaxPoints = 8;
  Vec3 normal = Vec3::UnitZ();  ///< unit, world, from b toward a
  FixedVector<ManifoldPoint, kMaxPoints> points;
};

/// m: by how much the overlap of two cylinders' rims may jump from one pose to the next: the prisms that stand for them
/// (convex.h) lie inside by 1 - cos(pi / 32) of the radius. RT-safe.
inline double roughnessOf(const PlacedConvex& a, const PlacedConvex& b) {
  constexpr double kSagitta = 0.005;
  return kSagitta * (a.shape->round_radius + b.shape->round_radius);
}
/// The points of `a` and `b` nearer than `margin` (m, >= 0) along the normal. False, and `out` unspecified, if there
/// are none. RT-safe.
bool findManifold(const PlacedConvex& a, const PlacedConvex& b, double margin, Manifold& out);

}  // namespace hl
