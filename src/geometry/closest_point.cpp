#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/features.h"

namespace hl {

namespace {

// Nearest point of the segment from vertex[edge.begin] to vertex[edge.end]: q = u + s (v - u) with s = (p - u).(v - u)
// / |v - u|^2 clamped to [0, 1]. The ends are used exactly, not as u + 1 (v - u).
void nearestOnEdge(const Primitive& primitive, std::size_t number, const Vec3& p, ClosestPoint& best) {
  const Edge& edge = kEdges[number];
  const Vec3& u = primitive.vertex[edge.begin];
  const Vec3& v = primitive.vertex[edge.end];
  const Vec3 along = v - u;
  const double s = along.dot(p - u) / along.squaredNorm();
  const bool at_begin = !(s > 0);
  const bool at_end = s >= 1;
  const Vec3 q = at_begin ? u : at_end ? v : Vec3(u + s * along);
  const double distance = (p - q).norm();
  if (!(distance < best.distance)) return;
  best.distance = distance;
  best.point = q;
  best.feature = at_begin ? vertexFeature(edge.begin) : at_end ? vertexFeature(edge.end) : edgeFeature(number);
  best.weights = at_begin ? vertexWeights(edge.begin) : at_end ? vertexWeights(edge.end) : edgeWeights(edge, s);
}

ClosestPoint nearestOfTriangle(const Primitive& triangle, const Vec3& p) {
  ClosestPoint best;
  const FaceAreas areas = faceAreas(triangle, p);
  if (areas.inside()) {
    const double height = triangle.normal.dot(p - triangle.vertex[0]);
    best.distance = std::abs(height);
    best.point = p - height * triangle.normal;
    best.normal = height < 0 ? Vec3(-triangle.normal) : triangle.normal;
    best.feature = Feature::kFace;
    best.weights = areas.weights();
    return best;
  }
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t edge = 0; edge < 3; ++edge) nearestOnEdge(triangle, edge, p, best);
  best.normal = best.distance > 0 ? Vec3((p - best.point) / best.distance) : triangle.normal;
  return best;
}

ClosestPoint nearestOfSegment(const Primitive& segment, const Vec3& p) {
  ClosestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  constexpr std::size_t kFromVertex0To1 = 2;
  nearestOnEdge(segment, kFromVertex0To1, p, best);
  if (best.feature == Feature::kEdge2) best.feature = Feature::kEdge0;
  best.normal = best.distance > 0 ? Vec3((p - best.point) / best.distance)
                                  : (segment.vertex[1] - segment.vertex[0]).normalized().unitOrthogonal();
  return best;
}

ClosestPoint nearestOfPoint(const Primitive& point, const Vec3& p) {
  ClosestPoint best;
  best.point = point.vertex[0];
  best.feature = Feature::kVertex0;
  best.distance = (p - best.point).norm();
  best.normal = best.distance > 0 ? Vec3((p - best.point) / best.distance) : Vec3::UnitZ();
  return best;
}

}  // namespace

ClosestPoint closestPoint(const Primitive& primitive, const Vec3& p) {
  switch (primitive.kind) {
    case PrimitiveKind::kTriangle:
      return nearestOfTriangle(primitive, p);
    case PrimitiveKind::kSegment:
      return nearestOfSegment(primitive, p);
    case PrimitiveKind::kPoint:
      break;
  }
  return nearestOfPoint(primitive, p);
}

bool closestPointWithin(const Primitive& primitive, const Vec3& p, double distance, ClosestPoint& out) {
  if (primitive.kind == PrimitiveKind::kTriangle && std::abs(primitive.normal.dot(p - primitive.vertex[0])) > distance)
    return false;
  out = closestPoint(primitive, p);
  return true;
}

}  // namespace hl
