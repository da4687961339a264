#include "geometry/primitive.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

bool lexicographicallyLess(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Adding zero turns -0 into +0, so that equal vertices have equal bits.
Vec3 canonical(const Vec3& a) { return (a.array() + 0.0).matrix(); }

// Sorts the first `count` vertices; returns whether the permutation is odd.
bool sortVertices(Primitive& primitive, int count) {
  bool odd = false;
  for (int i = 1; i < count; ++i) {
    for (auto j = static_cast<std::size_t>(i); j > 0; --j) {
      if (!lexicographicallyLess(primitive.vertex[j], primitive.vertex[j - 1])) break;
      std::swap(primitive.vertex[j], primitive.vertex[j - 1]);
      std::swap(primitive.order[j], primitive.order[j - 1]);
      odd = !odd;
    }
  }
  return odd;
}

}  // namespace

bool makeTriangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t source, Primitive& out) {
  if (!a.allFinite() || !b.allFinite() || !c.allFinite()) return false;
  Primitive triangle;
  triangle.kind = PrimitiveKind::kTriangle;
  triangle.source = source;
  triangle.vertex = {canonical(a), canonical(b), canonical(c)};
  const bool odd = sortVertices(triangle, 3);

  // The two shorter edges give the cross product with the least rounding: its error is about
  // epsilon |e1| |e2|, and they are the smallest factors. i is the vertex where they meet.
  const auto& v = triangle.vertex;
  std::array<double, 3> edge{};
  for (std::size_t i = 0; i < 3; ++i) edge[i] = (v[(i + 2) % 3] - v[(i + 1) % 3]).norm();
  const auto i = static_cast<std::size_t>(std::max_element(edge.begin(), edge.end()) - edge.begin());
  const Vec3 cross = (v[(i + 1) % 3] - v[i]).cross(v[(i + 2) % 3] - v[i]);
  const double twice_area = cross.norm();
  if (!std::isfinite(twice_area) || !std::isfinite(edge[i])) return false;
  if (!(twice_area > kSliver * edge[i] * edge[i])) return false;

  // In a sliver that error tilts the normal along the longest edge, where it costs most; the tilt is taken out. What
  // remains turns it about that edge, over a height so small that no distance notices.
  const Vec3 along = (v[(i + 2) % 3] - v[(i + 1) % 3]) / edge[i];
  Vec3 normal = cross / (odd ? -twice_area : twice_area);
  for (int pass = 0; pass < 2; ++pass) normal = (normal - normal.dot(along) * along).normalized();
  triangle.normal = normal;
  out = triangle;
  return true;
}

bool makeSegment(const Vec3& a, const Vec3& b, std::uint32_t source, Primitive& out) {
  if (!a.allFinite() || !b.allFinite()) return false;
  const double square = (b - a).squaredNorm();
  if (!std::isfinite(square) || !(square > 0)) return false;
  Primitive segment;
  segment.kind = PrimitiveKind::kSegment;
  segment.source = source;
  segment.vertex = {canonical(a), canonical(b), Vec3::Zero()};
  sortVertices(segment, 2);
  segment.vertex[2] = segment.vertex[1];
  segment.order[2] = segment.order[1];
  out = segment;
  return true;
}

bool makePoint(const Vec3& a, std::uint32_t source, Primitive& out) {
  if (!a.allFinite()) return false;
  Primitive point;
  point.kind = PrimitiveKind::kPoint;
  point.source = source;
  point.vertex.fill(canonical(a));
  point.order.fill(0);
  out = point;
  return true;
}

}  // namespace hl
