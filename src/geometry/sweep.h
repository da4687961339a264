// Time of impact of a sphere that moves along a line against one primitive: the moving point against the primitive's
// configuration-space obstacle (the paper's section 3): two offset faces, edge cylinders and vertex spheres.
#pragma once

#include <array>

#include "base/vec.h"
#include "geometry/closest_point.h"
#include "geometry/primitive.h"

namespace hl {

/// First contact of a sweep. Valid only when the sweep returned true.
struct Impact {
  double t = 0;                            ///< fraction of the motion, 0..1
  Feature feature = Feature::kFace;        ///< what is hit (kEdge0 inside a segment, kVertex0 on a point)
  Vec3 normal = Vec3::UnitZ();             ///< unit, from the primitive toward the sphere's centre at time t
  std::array<double, 3> weights{1, 0, 0};  ///< touched point = sum of weights[i] * vertex[i] (sorted order)
};

/// Moves a sphere of `radius` (m, > 0) from `from` by `motion` and finds when it first touches `primitive`.
/// A sphere that starts within `radius` hits at t = 0 when it approaches (motion . normal < 0) and else never, as the
/// primitive is convex. Returns false, and leaves `out` alone, when nothing is hit. RT-safe, any thread.
bool sweepSphere(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius, Impact& out);
/// The same for a caller that has the closest point of `from`.
bool sweepSphere(const Primitive& primitive, const ClosestPoint& start, const Vec3& from, const Vec3& motion,
                 double radius, Impact& out);
/// The same for a caller that knows that the sphere starts farther than `radius`, and ignores what is hit after
/// `latest`, a fraction of the motion: such a hit may be returned or not.
bool sweepSphereFromOutside(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius,
                            double latest, Impact& out);

}  // namespace hl
