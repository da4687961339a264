// Pair along: how two shapes lie along a normal that points from the second to the first.
//
// While the middle of the first lies above that of the second, the shorter way apart is along the normal. Beyond it the
// first has passed: a manifold there would push it on, or they are apart again, on the wrong sides.
#pragma once

#include <algorithm>
#include <limits>

#include "bodies/placed_convex.h"

namespace hl {

struct PairAlong {
  double gap = 0;      ///< m, from the highest point of b up to the lowest of a
  double middles = 0;  ///< m, from the middle of b up to that of a

  bool hasPassed() const { return middles < 0; }
};

/// RT-safe.
inline PairAlong pairAlong(const PlacedConvex& a, const PlacedConvex& b, const Vec3& normal) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double low_a = kInfinite, high_a = -kInfinite, low_b = kInfinite, high_b = -kInfinite;
  for (const Vec3& vertex : a.vertices) {
    low_a = std::min(low_a, normal.dot(vertex));
    high_a = std::max(high_a, normal.dot(vertex));
  }
  for (const Vec3& vertex : b.vertices) {
    low_b = std::min(low_b, normal.dot(vertex));
    high_b = std::max(high_b, normal.dot(vertex));
  }
  return {low_a - high_b - a.shape->radius - b.shape->radius, (low_a + high_a - low_b - high_b) / 2};
}

}  // namespace hl
