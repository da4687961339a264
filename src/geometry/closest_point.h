// Closest point of a primitive to a point. It defines the distance of a contact and its direction.
#pragma once

#include <array>

#include "base/vec.h"
#include "geometry/primitive.h"

namespace hl {

/// The point of a primitive nearest to p. Every field is always valid.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();  ///< metres, frame of the primitive
  /// Unit, from the primitive toward p. On a face exactly +normal or -normal of the primitive. At distance 0:
  /// +normal for a triangle, some unit perpendicular for a segment, +z for a point.
  Vec3 normal = Vec3::UnitZ();
  double distance = 0;  ///< metres, >= 0; on a face |normal . (p - vertex[0])|, never less than the true distance
                        ///< by more than rounding
  Feature feature = Feature::kFace;        ///< kEdge0 for the inside of a segment, kVertex0 for a point
  std::array<double, 3> weights{1, 0, 0};  ///< point = sum of weights[i] * vertex[i] (sorted order), each in [0, 1]
};

/// Nearest point of `primitive` to `p`. Primitives that share an edge or a vertex give the same bits on it. RT-safe,
/// any thread. A non-finite p gives non-finite results.
ClosestPoint closestPoint(const Primitive& primitive, const Vec3& p);
/// As closestPoint(), but returns false at once if the plane of a triangle is farther than `distance` (m), as then the
/// triangle is too. `out` is then unchanged.
bool closestPointWithin(const Primitive& primitive, const Vec3& p, double distance, ClosestPoint& out);

}  // namespace hl
