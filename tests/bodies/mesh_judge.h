// Mesh judge: where a point is to a mesh, by plain searches over all of its triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "base/vec.h"

namespace hl::test {

using MeshTriangles = std::span<const std::array<std::uint32_t, 3>>;

/// m, from the surface: the distance to corners, edges and planes of the triangles.
inline double distanceToMesh(std::span<const Vec3> vertices, MeshTriangles triangles, const Vec3& point) {
  double least = 1e300;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 &p = vertices[a], &q = vertices[b], &r = vertices[c];
    const Vec3 normal = (q - p).cross(r - p).normalized();
    const auto beside = [&](const Vec3& from, const Vec3& to) { return normal.cross(to - from).dot(point - from) < 0; };
    if (!beside(p, q) && !beside(q, r) && !beside(r, p)) least = std::min(least, std::abs(normal.dot(point - p)));
    for (const auto& [from, to] : {std::pair{p, q}, {q, r}, {r, p}}) {
      const double part = std::clamp((point - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
      least = std::min(least, (from + part * (to - from) - point).norm());
    }
  }
  return least;
}

/// By solid angles (A. Van Oosterom, J. Strackee 1983): 1 inside, 0 outside.
inline double windingAt(std::span<const Vec3> vertices, MeshTriangles triangles, const Vec3& point) {
  double angle = 0;
  for (const auto& [i, j, k] : triangles) {
    const Vec3 a = vertices[i] - point, b = vertices[j] - point, c = vertices[k] - point;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  return angle / (4 * EIGEN_PI);
}

}  // namespace hl::test
