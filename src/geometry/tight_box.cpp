#include "geometry/tight_box.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// Of the diagonal of the bounds: what a box may be short of the surface by, but for the curvature of the ball. It grows
// with the primitives that were seen and rose no higher: else a search would go through all of a flat face.
constexpr double kShort = 1.0 / 40'000, kSeen = 200;

// The highest place along `out`, a unit vector, but for that. A ball much larger than the surface comes against it,
// nearly as a plane would, and may end where it could meet nothing higher any more. -HUGE_VAL: there is nothing.
double highestAlong(const PrimitiveSource& source, const SpatialIndex& index, const Vec3& out, double size) {
  constexpr double kBallOfSize = 4e4, kClear = 1.01;
  const Vec3 centre = source.bounds().centre();
  const double radius = kBallOfSize * size, way = kClear * size, begin = out.dot(centre) + 0.5 * way;
  double highest = -HUGE_VAL, seen = 0;
  index.sweep(centre + (radius + 0.5 * way) * out, -way * out, radius, 0, [&](ElementId candidate, double limit) {
    const double before = highest;
    for (const Vec3& corner : source.corners(candidate)) highest = std::max(highest, out.dot(corner));
    seen = highest > before + kShort * size ? 0 : seen + 1;
    return std::min(limit, std::max(0.0, (begin - highest) / way - kShort * (1 + seen / kSeen)));
  });
  return highest;
}

}  // namespace

Box tightBox(const PrimitiveSource& source, const SpatialIndex& index, const Mat3& turn) {
  constexpr double kRounding = 1e-9;
  const Box bounds = source.bounds();
  if (bounds.empty()) return {};
  const double size = std::max(bounds.size().norm(), kRounding * bounds.centre().norm());
  if (size == 0) return bounds;  // a point at the origin
  Box box;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 along = turn.row(axis).transpose();
    box.max[axis] = highestAlong(source, index, along, size);
    box.min[axis] = -highestAlong(source, index, -along, size);
  }
  return box.empty() ? Box{} : box;
}

}  // namespace hl
