// Hull planes: the faces of a convex hull of any number of points, as planes alone.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "bodies/half_space.h"

namespace hl {

/// Normals outward. None, if the points have no thickness. Unlike a shape, it has all the corners that there are.
std::vector<HalfSpace> hullPlanes(std::span<const Vec3> points);
/// m: from a point along a unit vector to where it leaves the hull; 0: it is outside, or
/// there is no hull.
double wayOut(std::span<const HalfSpace> hull, const Vec3& point, const Vec3& direction);

}  // namespace hl
