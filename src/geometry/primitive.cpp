#include "geometry/primitive.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

bool lexicographicallyLess(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Adding zero changes -0 to +0, so that equal vertices have equal bits.
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

// The longest edge of a triangle, the vertex opposite to it, and the cross product of the two shorter edges. This
// product has the smallest rounding error: about epsilon |e1| |e2|, with the smallest possible factors.
struct Outline {
  std::size_t corner;
  double longest2;  // m^2
  Vec3 cross;
};

Outline outlineOf(const std::array<Vec3, 3>& v) {
  Outline outline{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double edge2 = (v[(i + 2) % 3] - v[(i + 1) % 3]).squaredNorm();
    if (i > 0 && !(edge2 > outline.longest2)) continue;
    outline.corner = i;
    outline.longest2 = edge2;
  }
  const std::size_t i = outline.corner;
  outline.cross = (v[(i + 1) % 3] - v[i]).cross(v[(i + 2) % 3] - v[i]);
  return outline;
}

// One Newton step: the length then has an error of one rounding instead of two or three.
Vec3 unit(const Vec3& almost) { return (1.5 - 0.5 * almost.squaredNorm()) * almost; }

// The normal of a thin triangle. Rounding tilts it along the longest edge, where the effect on distances is largest;
// this tilt is removed. The remaining error turns the normal about that edge, over a height too small to affect
// distances.
Vec3 thinNormal(const std::array<Vec3, 3>& v) {
  const Outline outline = outlineOf(v);
  const Vec3 along = (v[(outline.corner + 2) % 3] - v[(outline.corner + 1) % 3]).normalized();
  Vec3 normal = outline.cross.normalized();
  for (int pass = 0; pass < 2; ++pass) normal = (normal - normal.dot(along) * along).normalized();
  return normal;
}

// Unit normal by the right-hand rule.
Vec3 normalOf(const std::array<Vec3, 3>& v) {
  constexpr double kThin = 0.1;  // sine of the angle at the first vertex: above it the tilt is below 1e-14 rad
  const Vec3 ab = v[1] - v[0], ac = v[2] - v[0];
  const Vec3 cross = ab.cross(ac);
  const double square = cross.squaredNorm();
  if (square < kThin * kThin * ab.squaredNorm() * ac.squaredNorm()) return thinNormal(v);
  return unit(1 / std::sqrt(square) * cross);
}

}  // namespace

bool isTriangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (!withinReach(a) || !withinReach(b) || !withinReach(c)) return false;
  const Outline outline = outlineOf({a, b, c});
  return outline.cross.norm() > kSliver * outline.longest2;
}

bool isSegment(const Vec3& a, const Vec3& b) { return withinReach(a) && withinReach(b) && (b - a).squaredNorm() > 0; }

Primitive triangleOf(const Vec3& a, const Vec3& b, const Vec3& c, ElementId source) {
  Primitive triangle;
  triangle.kind = PrimitiveKind::kTriangle;
  triangle.source = source;
  triangle.vertex = {canonical(a), canonical(b), canonical(c)};
  const bool odd = sortVertices(triangle, 3);
  const Vec3 normal = normalOf(triangle.vertex);
  triangle.normal = odd ? Vec3(-normal) : normal;
  return triangle;
}

Primitive segmentOf(const Vec3& a, const Vec3& b, ElementId source) {
  Primitive segment;
  segment.kind = PrimitiveKind::kSegment;
  segment.source = source;
  segment.vertex = {canonical(a), canonical(b), Vec3::Zero()};
  sortVertices(segment, 2);
  segment.vertex[2] = segment.vertex[1];
  segment.order[2] = segment.order[1];
  return segment;
}

Primitive pointOf(const Vec3& a, ElementId source) {
  Primitive point;
  point.kind = PrimitiveKind::kPoint;
  point.source = source;
  point.vertex.fill(canonical(a));
  point.order.fill(0);
  return point;
}

Primitive shrunkenOf(PrimitiveKind kind, const std::array<Vec3, 3>& corners, ElementId source) {
  const auto& v = corners;
  if (kind == PrimitiveKind::kTriangle) {
    if (isTriangle(v[0], v[1], v[2])) return triangleOf(v[0], v[1], v[2], source);
    const std::size_t opposite = outlineOf(v).corner;
    const Vec3 &a = v[(opposite + 1) % 3], &b = v[(opposite + 2) % 3];
    return isSegment(a, b) ? segmentOf(a, b, source) : pointOf(a, source);
  }
  if (kind == PrimitiveKind::kSegment && isSegment(v[0], v[1])) return segmentOf(v[0], v[1], source);
  return pointOf(v[0], source);
}

bool makeTriangle(const Vec3& a, const Vec3& b, const Vec3& c, ElementId source, Primitive& out) {
  if (!isTriangle(a, b, c)) return false;
  out = triangleOf(a, b, c, source);
  return true;
}

}  // namespace hl
