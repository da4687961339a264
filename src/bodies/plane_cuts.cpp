#include "bodies/plane_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

namespace {

// The part of a triangle at or above the plane: a convex polygon.
void keepAbove(const Triangle3& triangle, const HalfSpace& plane, double rounding, std::vector<Vec3>& kept) {
  kept.clear();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
    const double at_a = plane.above(a), at_b = plane.above(b);
    if (at_a >= -rounding) kept.push_back(a);
    if (std::min(at_a, at_b) < -rounding && std::max(at_a, at_b) > rounding)
      kept.emplace_back(a + at_a / (at_a - at_b) * (b - a));
  }
}

}  // namespace

CutSurface above(const CutSurface& surface, const HalfSpace& plane, double rounding) {
  CutSurface side;
  std::vector<Vec3> kept;
  for (const Triangle3& triangle : surface) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& corner : triangle) {
      low = std::min(low, plane.above(corner));
      high = std::max(high, plane.above(corner));
    }
    const bool lies_in_it = low >= -rounding && high <= rounding;
    const Vec3 across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (lies_in_it && plane.normal.dot(across) < 0) side.push_back(triangle);
    if (lies_in_it || high <= rounding) continue;
    keepAbove(triangle, plane, rounding, kept);
    for (std::size_t i = 2; i < kept.size(); ++i) side.push_back({kept[0], kept[i - 1], kept[i]});
  }
  return side;
}

}  // namespace hl
