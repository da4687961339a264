// Nearest points of two convex shapes that are apart, by trying all pairs of features.
#pragma once

#include "bodies/placed_convex.h"

namespace hl {

struct NearestPoints {
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();  ///< m, world, on the polytopes before they are grown
  Vec3 normal = Vec3::UnitZ();                    ///< unit, from b toward a
  double distance = 0;                            ///< m between the polytopes; < 0 if a point is inside
};

/// Of a point and a polytope. The distance is negative inside a polyhedron. RT-safe.
NearestPoints nearestToPoint(const Vec3& point, const PlacedConvex& polytope);
/// Of two polytopes that are apart; where they touch or overlap the normal is not defined, and the result false.
/// RT-safe.
bool nearestPoints(const PlacedConvex& a, const PlacedConvex& b, NearestPoints& out);

}  // namespace hl
