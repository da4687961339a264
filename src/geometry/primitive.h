// Primitive: a triangle, a segment or a point, two-sided and of zero thickness: the elements of every scene.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "geometry/element_id.h"

namespace hl {

enum class PrimitiveKind : std::uint8_t { kPoint = 1, kSegment = 2, kTriangle = 3 };  // the number of vertices

/// The part of a primitive on which a point lies. Edge i is opposite vertex i (so edge 0 joins vertices 1 and 2).
enum class Feature : std::uint8_t { kFace, kEdge0, kEdge1, kEdge2, kVertex0, kVertex1, kVertex2 };

/// Vertices are stored in lexicographic order, so that two primitives that share an edge or a vertex compute the same
/// bits on it. `order` gives the original order.
struct Primitive {
  std::array<Vec3, 3> vertex;  ///< a segment has vertex[2] == vertex[1], a point has all three equal
  Vec3 normal = Vec3::Zero();  ///< unit face normal by the right-hand rule of the *given* order; triangles only
  PrimitiveKind kind = PrimitiveKind::kPoint;
  std::array<std::uint8_t, 3> order{0, 1, 2};  ///< vertex[i] was vertex order[i] of the input
  ElementId source = 0;                        ///< index of its element in the model's list of that kind
};

/// Maximum coordinate of a primitive, m. A proxy with a radius of a metre still works there, and products of lengths
/// stay far below overflow.
inline constexpr double kFarthest_m = 1e9;
/// Whether all coordinates of a point are within kFarthest_m; false if one is not finite.
inline bool withinReach(const Vec3& p) { return (p.array().abs() <= kFarthest_m).all(); }

/// Whether the vertices form a valid triangle or segment: all within reach, and with a non-zero area or length. A
/// triangle is invalid if its height over the longest edge is below kSliver times that edge. RT-safe.
bool isTriangle(const Vec3& a, const Vec3& b, const Vec3& c);
bool isSegment(const Vec3& a, const Vec3& b);

/// Makes the primitive; the vertices must be valid. RT-safe.
Primitive triangleOf(const Vec3& a, const Vec3& b, const Vec3& c, ElementId source);
Primitive segmentOf(const Vec3& a, const Vec3& b, ElementId source);
Primitive pointOf(const Vec3& a, ElementId source);

/// The primitive of an element of this kind whose vertices, all within reach, may have become degenerate: a triangle
/// that has shrunk to a line becomes its longest edge, and an element that has shrunk to a point becomes that point.
/// The last of a segment's `corners` is ignored. RT-safe.
Primitive shrunkenOf(PrimitiveKind kind, const std::array<Vec3, 3>& corners, ElementId source);

/// Checks and makes a triangle. Returns false, and leaves `out` unchanged, if the vertices are not valid.
bool makeTriangle(const Vec3& a, const Vec3& b, const Vec3& c, ElementId source, Primitive& out);

/// Below this ratio of height to longest edge the face normal of a triangle has fewer than five good digits.
inline constexpr double kSliver = 1e-11;

}  // namespace hl
