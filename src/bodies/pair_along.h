// Pair along: how two shapes lie along a normal that points from the second to the first.
//
// While the middle of the first lies above that of the second, the shorter way apart is along the normal. Beyond it the
// first has passed: a manifold there would push it on, or they are apart again, on the wrong sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/cylinder.h"

namespace hl {

struct PairAlong {
  double gap = 0;      ///< m, from the highest point of b up to the lowest of a
  double middles = 0;  ///< m, from the middle of b up to that of a

  bool hasPassed() const { return middles < 0; }
};

/// m, along a normal.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

/// Without the radius by which the shape is grown; a cylinder's is the true one. RT-safe.
inline Extent extentOf(const PlacedConvex& shape, const Vec3& normal) {
  if (isRound(shape)) {
    const CylinderFrame frame = frameOf(shape);
    const double middle = normal.dot(frame.middle), along = normal.dot(frame.axis);
    const double half =
        frame.half_length * std::abs(along) + shape.shape->round_radius * (normal - along * frame.axis).norm();
    return {middle - half, middle + half};
  }
  Extent extent;
  for (const Vec3& vertex : shape.vertices) {
    const double height = normal.dot(vertex);
    extent.low = std::min(extent.low, height);
    extent.high = std::max(extent.high, height);
  }
  return extent;
}

/// RT-safe.
inline PairAlong pairAlong(const PlacedConvex& a, const PlacedConvex& b, const Vec3& normal) {
  const Extent of_a = extentOf(a, normal), of_b = extentOf(b, normal);
  return {of_a.low - of_b.high - a.shape->radius - b.shape->radius, (of_a.low + of_a.high - of_b.low - of_b.high) / 2};
}

}  // namespace hl
