#include "geometry/tight_box.h"

#include <algorithm>

#include "geometry/queries.h"

namespace hl {

// A ball much larger than the surface comes along the direction, nearly as a plane would: what it meets first is at
// most size^2 / (2 radius) below the highest point.
Box tightBox(const PrimitiveSource& source, const SpatialIndex& index, const Mat3& turn) {
  constexpr double kBallOfSize = 1e4, kClear = 1.01, kRounding = 1e-9;
  const Box bounds = source.bounds();
  if (bounds.empty()) return {};
  const double size = std::max(bounds.size().norm(), kRounding * bounds.centre().norm());
  if (size == 0) return bounds;  // a point at the origin
  Primitive last;
  const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(source, id); };
  Box box;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 out = sign * turn.row(axis).transpose();
      const double radius = kBallOfSize * size;
      FirstImpact first;
      if (!firstImpact(index, read, bounds.centre() + (radius + 0.5 * kClear * size) * out, -kClear * size * out,
                       radius, 0, first))
        return {};
      double& side = (sign < 0 ? box.min : box.max)[axis];
      for (const Vec3& corner : source.corners(first.primitive)) {
        const double at = turn.row(axis).dot(corner);
        side = sign < 0 ? std::min(side, at) : std::max(side, at);
      }
    }
  }
  return box;
}

}  // namespace hl
