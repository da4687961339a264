// Faces of a convex hull: which of the points are its corners, by qhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The
// quickhull algorithm for convex hulls, ACM Transactions on Mathematical Software 22, 1996).
#pragma once

#include <cstddef>
#include <vector>

#include "bodies/convex.h"
#include "bodies/half_space.h"

namespace hl {

struct HullFaces {
  std::vector<std::size_t> points;                ///< numbers of the points that are vertices
  std::vector<std::vector<Convex::Index>> faces;  ///< counterclockwise; corners: places in `points`
  double error = 0;                               ///< how far a point is outside, at most, in the unit of the points
};

/// Of points of a size of about 1 around the origin, not all in a plane. At most kMaxVertices of them are kept: those
/// that reach farthest. Throws Error if there is no hull.
HullFaces hullFaces(const std::vector<Vec3>& points);
/// The faces of such points' hull, with all corners that there are; normals outward.
std::vector<HalfSpace> unitHullPlanes(const std::vector<Vec3>& points);

/// Some of the points.
inline std::vector<Vec3> pointsOf(const std::vector<Vec3>& points, const std::vector<std::size_t>& numbers) {
  std::vector<Vec3> some;
  some.reserve(numbers.size());
  for (const std::size_t number : numbers) some.push_back(points[number]);
  return some;
}

}  // namespace hl
