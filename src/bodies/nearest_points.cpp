#include "bodies/nearest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/cylinder.h"

namespace hl {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

void keepNearer(NearestPoints& best, const Vec3& on_a, const Vec3& on_b) {
  const Vec3 way = on_a - on_b;
  const double distance = way.norm();
  if (distance >= best.distance) return;
  best.on_a = on_a;
  best.on_b = on_b;
  best.distance = distance;
  if (distance > 0) best.normal = way / distance;
}

Vec3 nearestOnSegment(const Vec3& p, const Vec3& begin, const Vec3& end) {
  const Vec3 way = end - begin;
  const double square = way.squaredNorm();
  return square > 0 ? Vec3(begin + std::clamp(way.dot(p - begin) / square, 0.0, 1.0) * way) : begin;
}

bool aboveFace(const Vec3& p, const PlacedConvex& of, std::size_t face) {
  const auto& corners = of.shape->faces[face].corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = of.vertices[corners[i]];
    const Vec3& to = of.vertices[corners[(i + 1) % corners.size()]];
    if ((to - from).cross(of.normals[face]).dot(p - from) > 0) return false;
  }
  return true;
}

// Ericson, section 5.1.9; of parallel segments one end of the first is taken.
void nearestOfSegments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1, Vec3& on_a, Vec3& on_b) {
  const Vec3 da = a1 - a0, db = b1 - b0, r = a0 - b0;
  const double aa = da.squaredNorm(), bb = db.squaredNorm(), ab = da.dot(db);
  const double determinant = aa * bb - ab * ab;
  double s = 0;
  if (determinant > 1e-12 * aa * bb) s = std::clamp((ab * db.dot(r) - bb * da.dot(r)) / determinant, 0.0, 1.0);
  on_b = nearestOnSegment(a0 + s * da, b0, b1);
  on_a = nearestOnSegment(on_b, a0, a1);
}

NearestPoints nearestToCylinder(const Vec3& point, const PlacedConvex& cylinder) {
  const CylinderFrame frame = frameOf(cylinder);
  const double along = frame.axis.dot(point - frame.middle);
  const Vec3 across = point - frame.middle - along * frame.axis;
  const double from_axis = across.norm(), radius = cylinder.shape->round_radius;
  const Vec3 radial = from_axis > 0 ? Vec3(across / from_axis) : cylinder.normals[2];
  const Vec3 end = along > 0 ? frame.axis : Vec3(-frame.axis);
  const double above = std::abs(along) - frame.half_length, beside = from_axis - radius;
  if (beside <= 0 && above >= beside) return {point, point - above * end, end, above};
  if (above <= 0) return {point, point - beside * radial, radial, beside};
  const Vec3 way = above * end + beside * radial;
  const double distance = way.norm();
  return {point, point - way, way / distance, distance};
}

}  // namespace

NearestPoints nearestToPoint(const Vec3& point, const PlacedConvex& polytope) {
  if (isRound(polytope)) return nearestToCylinder(point, polytope);
  NearestPoints best;
  best.distance = kInfinite;
  std::size_t highest = 0;
  double height = -kInfinite;
  for (std::size_t face = 0; face < polytope.normals.size(); ++face) {
    const Vec3& corner = polytope.vertices[polytope.shape->faces[face].corners[0]];
    const double above = polytope.normals[face].dot(point - corner);
    if (above > height) {
      height = above;
      highest = face;
    }
    if (above >= 0 && above < best.distance && aboveFace(point, polytope, face)) {
      best = {point, point - above * polytope.normals[face], polytope.normals[face], above};
    }
  }
  constexpr std::size_t kFacesOfTriangle = 2;
  if (polytope.normals.size() > kFacesOfTriangle && height <= 0)
    return {point, point - height * polytope.normals[highest], polytope.normals[highest], height};
  for (const Convex::Edge& edge : polytope.shape->edges)
    keepNearer(best, point, nearestOnSegment(point, polytope.vertices[edge.begin], polytope.vertices[edge.end]));
  if (polytope.vertices.size() == 1) keepNearer(best, point, polytope.vertices[0]);
  return best;
}

bool nearestPoints(const PlacedConvex& a, const PlacedConvex& b, NearestPoints& out) {
  NearestPoints best;
  best.distance = kInfinite;
  for (const Vec3& vertex : a.vertices) {
    const NearestPoints one = nearestToPoint(vertex, b);
    if (one.distance < best.distance) best = one;
  }
  for (const Vec3& vertex : b.vertices) {
    const NearestPoints one = nearestToPoint(vertex, a);
    if (one.distance < best.distance) best = {one.on_b, one.on_a, -one.normal, one.distance};
  }
  for (const Convex::Edge& ea : a.shape->edges) {
    for (const Convex::Edge& eb : b.shape->edges) {
      Vec3 on_a, on_b;
      nearestOfSegments(a.vertices[ea.begin], a.vertices[ea.end], b.vertices[eb.begin], b.vertices[eb.end], on_a, on_b);
      keepNearer(best, on_a, on_b);
    }
  }
  if (!(best.distance > 0)) return false;
  out = best;
  return true;
}

}  // namespace hl
