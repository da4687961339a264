// Time of impact of a sphere, moving on a line, with one primitive. It is computed for a moving point and the
// primitive's configuration-space obstacle (the paper's section 3): two offset faces, edge cylinders and vertex
// spheres.
#pragma once

#include <array>

#include "base/vec.h"
#include "geometry/closest_point.h"
#include "geometry/primitive.h"

namespace hl {

/// First contact of a sweep. Valid only when the sweep returned true.
struct Impact {
  double t = 0;                            ///< fraction of the motion, 0..1
  Feature feature = Feature::kFace;        ///< the feature that is hit (kEdge0 inside a segment, kVertex0 on a point)
  Vec3 normal = Vec3::UnitZ();             ///< unit, from the primitive toward the sphere's centre at time t
  std::array<double, 3> weights{1, 0, 0};  ///< contact point = sum of weights[i] * vertex[i] (sorted order)
};

/// Finds when a sphere of `radius` (m, > 0), moving from `from` by `motion`, first touches `primitive`. A sphere that
/// starts within `radius` hits at t = 0 if it approaches (motion . normal < 0), else never, as the primitive is convex.
/// Returns false, and leaves `out` unchanged, if nothing is hit. RT-safe, any thread.
bool sweepSphere(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius, Impact& out);
/// The same, with `start`, the closest point to `from`, already computed.
bool sweepSphere(const Primitive& primitive, const ClosestPoint& start, const Vec3& from, const Vec3& motion,
                 double radius, Impact& out);
/// The same, for a sphere that starts farther than `radius`. An impact after `latest` (a fraction of the motion) may be
/// reported or not.
bool sweepSphereFromOutside(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius,
                            double latest, Impact& out);

}  // namespace hl
