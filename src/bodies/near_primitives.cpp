#include "bodies/near_primitives.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

namespace {

double lowestAlong(const Vec3& normal, std::span<const Vec3> vertices) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : vertices) lowest = std::min(lowest, normal.dot(vertex));
  return lowest;
}

}  // namespace

// The vertices of a cylinder are those of a prism within it.
double separationBound(const PlacedConvex& shape, const ClosestPoint& nearest) {
  constexpr double kBeyondPrism = 0.005;  // of the radius of a cylinder: more than 1 - cos(pi / kCylinderSides)
  const double to_point = nearest.normal.dot(shape.centre) - nearest.distance;
  return lowestAlong(nearest.normal, shape.vertices) - to_point - shape.shape->radius -
         kBeyondPrism * shape.shape->round_radius;
}

double separationBound(const PlacedConvex& shape, const PlacedConvex& primitive, const ClosestPoint& nearest) {
  double most = separationBound(shape, nearest) - primitive.shape->radius;
  if (isRound(shape)) return most;
  const double radius = shape.shape->radius + primitive.shape->radius;
  for (const Vec3& normal : primitive.normals)
    most = std::max(most, lowestAlong(normal, shape.vertices) - normal.dot(primitive.vertices[0]) - radius);
  for (std::size_t i = 0; i < shape.normals.size(); ++i) {
    const Vec3& on_face = shape.vertices[shape.shape->faces[i].corners[0]];
    most = std::max(most, lowestAlong(shape.normals[i], primitive.vertices) - shape.normals[i].dot(on_face) - radius);
  }
  return most;
}

std::size_t NearPrimitives::octantOf(const ClosestPoint& nearest) {
  const Vec3& way = nearest.normal;
  return (way.x() > 0 ? 1U : 0U) + (way.y() > 0 ? 2U : 0U) + (way.z() > 0 ? 4U : 0U);
}

bool NearPrimitives::before(const Candidate& a, const Candidate& b, const SceneAt& scene) {
  if (a.separation_um != b.separation_um) return a.separation_um < b.separation_um;
  if (a.distance != b.distance) return a.distance > b.distance;
  return scene.precedes(a.id, b.id);
}

bool NearPrimitives::has(PrimitiveId id, const ClosestPoint& nearest) const {
  const auto& octant = octants_[octantOf(nearest)];
  return std::any_of(octant.begin(), octant.end(), [&](const Candidate& one) { return one.id == id; });
}

void NearPrimitives::add(PrimitiveId id, double separation_m, const ClosestPoint& nearest, const SceneAt& scene) {
  auto& octant = octants_[octantOf(nearest)];
  const Candidate one{id, std::floor(separation_m * 1e6), nearest.distance};
  if (!octant.push(one)) {
    const auto last = std::max_element(octant.begin(), octant.end(),
                                       [&](const Candidate& a, const Candidate& b) { return before(a, b, scene); });
    if (before(one, *last, scene)) *last = one;
  }
}

}  // namespace hl
