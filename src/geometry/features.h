// Edges of a primitive: the vertices they join, and the name of a point on them. Internal to src/geometry.
#pragma once

#include <array>
#include <cstddef>

#include "geometry/primitive.h"

namespace hl {

/// Ends of edge i, which is opposite vertex i. The lexicographically smaller vertex is first, so that all primitives
/// with this edge start their sums at the same end.
struct Edge {
  std::size_t begin;
  std::size_t end;
};
inline constexpr std::array<Edge, 3> kEdges{{{1, 2}, {0, 2}, {0, 1}}};

inline Feature edgeFeature(std::size_t edge) {
  return static_cast<Feature>(static_cast<int>(Feature::kEdge0) + static_cast<int>(edge));
}
inline Feature vertexFeature(std::size_t vertex) {
  return static_cast<Feature>(static_cast<int>(Feature::kVertex0) + static_cast<int>(vertex));
}

inline std::array<double, 3> vertexWeights(std::size_t vertex) {
  std::array<double, 3> weights{};
  weights[vertex] = 1;
  return weights;
}

/// Weights of begin + s (end - begin).
inline std::array<double, 3> edgeWeights(const Edge& edge, double s) {
  std::array<double, 3> weights{};
  weights[edge.begin] = 1 - s;
  weights[edge.end] = s;
  return weights;
}

/// Twice the signed areas of the triangles formed by p and each edge, seen along the face normal. All are >= 0 exactly
/// if p projects into the triangle.
struct FaceAreas {
  std::array<double, 3> area{};
  bool inside() const { return area[0] >= 0 && area[1] >= 0 && area[2] >= 0; }
  /// Barycentric weights; call only when inside.
  std::array<double, 3> weights() const {
    const double sum = area[0] + area[1] + area[2];
    if (!(sum > 0)) return vertexWeights(0);
    return {area[0] / sum, area[1] / sum, area[2] / sum};
  }
};

inline FaceAreas faceAreas(const Primitive& triangle, const Vec3& p) {
  const auto& v = triangle.vertex;
  // If sorting was an odd permutation, the sorted vertices have the opposite orientation.
  const bool even = (triangle.order[0] + 1) % 3 == triangle.order[1];
  const Vec3 n = even ? triangle.normal : Vec3(-triangle.normal);
  FaceAreas areas;
  areas.area[0] = (v[2] - v[1]).cross(p - v[1]).dot(n);
  areas.area[1] = -(v[2] - v[0]).cross(p - v[0]).dot(n);
  areas.area[2] = (v[1] - v[0]).cross(p - v[0]).dot(n);
  return areas;
}

}  // namespace hl
