#include "bodies/cylinder.h"

#include <cmath>

#include "base/plain_math.h"

namespace hl {

namespace {

// Of a unit vector: what is nearer to the axis gives no side of it.
constexpr double kAlongAxis = 1e-5;

// Cosine and sine of each half side: 2 i of edge i, 2 i + 1 of the side after it.
const std::array<std::array<double, 2>, 2 * kCylinderSides>& angles() {
  static const auto table = [] {
    std::array<std::array<double, 2>, 2 * kCylinderSides> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      const double angle = EIGEN_PI * static_cast<double>(i) / kCylinderSides;
      made[i] = {plain::cos(angle), plain::sin(angle)};
    }
    return made;
  }();
  return table;
}

}  // namespace

// Vertices 0 and 33 are opposite corners of the prism, 0 and 1 ends of one edge (convex.cpp).
CylinderFrame frameOf(const PlacedConvex& cylinder) {
  const Vec3& low = cylinder.vertices[0];
  return {(low + cylinder.vertices[kCylinderSides + 1]) / 2, cylinder.normals[1],
          cylinder.normals[1].dot(cylinder.vertices[1] - low) / 2};
}

Vec3 radialOf(const PlacedConvex& cylinder, const Vec3& point, const Vec3& otherwise) {
  const CylinderFrame frame = frameOf(cylinder);
  const Vec3 way = point - frame.middle, across = way - frame.axis.dot(way) * frame.axis;
  const double length = across.norm();
  return length > 0 ? Vec3(across / length) : otherwise;
}

PlacedConvex turnedPrism(const PlacedConvex& cylinder, const Vec3& direction, PrismTurn turn, PlacedRoom& room) {
  const CylinderFrame frame = frameOf(cylinder);
  Vec3 u = direction - frame.axis.dot(direction) * frame.axis;
  const double across = u.norm();
  if (!(across > kAlongAxis)) return cylinder;
  u /= across;
  const Vec3 w = frame.axis.cross(u), end = frame.half_length * frame.axis;
  // Around the circle for a side, within it for an edge.
  const bool side = turn == PrismTurn::kSide;
  const double radius = cylinder.shape->round_radius / (side ? angles()[1][0] : 1);
  const std::size_t begin = side ? 2 * kCylinderSides - 1 : 0;
  room.normals[0] = -frame.axis;
  room.normals[1] = frame.axis;
  for (std::size_t i = 0; i < kCylinderSides; ++i) {
    const auto& [cos_edge, sin_edge] = angles()[(begin + 2 * i) % angles().size()];
    const auto& [cos_side, sin_side] = angles()[(begin + 2 * i + 1) % angles().size()];
    const Vec3 edge = frame.middle + radius * (cos_edge * u + sin_edge * w);
    room.vertices[2 * i] = edge - end;
    room.vertices[2 * i + 1] = edge + end;
    room.normals[2 + i] = cos_side * u + sin_side * w;
  }
  return {cylinder.shape, std::span<const Vec3>(room.vertices).first(2 * kCylinderSides),
          std::span<const Vec3>(room.normals).first(kCylinderSides + 2), cylinder.centre, !side};
}

}  // namespace hl
