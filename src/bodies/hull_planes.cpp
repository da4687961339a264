#include "bodies/hull_planes.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "bodies/convex_hull.h"
#include "bodies/hull_faces.h"

namespace hl {

std::vector<HalfSpace> hullPlanes(std::span<const Vec3> points) {
  try {
    const UnitPoints unit = unitPoints(points);
    std::vector<HalfSpace> planes;
    for (const HalfSpace& plane : unitHullPlanes(unit.points))
      planes.push_back({plane.normal, unit.size * plane.offset + plane.normal.dot(unit.middle)});
    return planes;
  } catch (const Error&) {
    return {};
  }
}

double wayOut(std::span<const HalfSpace> hull, const Vec3& point, const Vec3& direction) {
  if (hull.empty()) return 0;
  double way = std::numeric_limits<double>::infinity();
  for (const HalfSpace& plane : hull) {
    const double toward = plane.normal.dot(direction);
    if (toward > 0) way = std::min(way, -plane.above(point) / toward);
  }
  return std::max(way, 0.0);
}

}  // namespace hl
