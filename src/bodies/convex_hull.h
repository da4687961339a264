// Convex hull of points, as the shape of a body.
#pragma once

#include <span>
#include <vector>

#include "bodies/convex.h"

namespace hl {

struct Hull {
  Convex shape;        ///< in the frame of the points: moved() brings it to its centre of mass
  double error_m = 0;  ///< how far a point is outside, at most; 0 unless the hull had too many vertices
};

/// Points as hullFaces() takes them: middle + size * point is where they were.
struct UnitPoints {
  std::vector<Vec3> points;
  Vec3 middle = Vec3::Zero();
  double size = 0;
};
/// Throws as hullOf().
UnitPoints unitPoints(std::span<const Vec3> points);

/// What points lie in: as thick as they are along `normal`.
struct Slab {
  Vec3 normal = Vec3::UnitX();
  double thickness = 0;
};
/// Where the points are the thinnest, by their second moments; `size`: theirs, about. Of points at one place (0): no
/// thickness.
Slab thinnestSlab(std::span<const Vec3> points, double size);

/// Points in one plane with others are one face. Of a hull of more than kMaxVertices those vertices are kept that
/// reach farthest: one by one, that which lies farthest outside of what is kept. Throws Error if a point is not finite,
/// or if they all lie in a plane (thinner than a millionth of their size).
Hull hullOf(std::span<const Vec3> points);

}  // namespace hl
