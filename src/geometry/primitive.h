// Primitive: a triangle, a segment or a point, two-sided and of zero width, the pieces every touchable scene is made
// of.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "geometry/element_id.h"

namespace hl {

enum class PrimitiveKind : std::uint8_t { kPoint = 1, kSegment = 2, kTriangle = 3 };  // the number of vertices

/// Where on a primitive a point lies. Edge i is opposite vertex i (so edge 0 joins vertices 1 and 2).
enum class Feature : std::uint8_t { kFace, kEdge0, kEdge1, kEdge2, kVertex0, kVertex1, kVertex2 };

/// Vertices are kept in lexicographic order, so that two primitives that share an edge or a vertex compute
/// the same bits on it; `order` maps them back to the order in which they were given.
struct Primitive {
  std::array<Vec3, 3> vertex;  ///< a segment has vertex[2] == vertex[1], a point has all three equal
  Vec3 normal = Vec3::Zero();  ///< unit face normal by the right-hand rule of the *given* order; triangles only
  PrimitiveKind kind = PrimitiveKind::kPoint;
  std::array<std::uint8_t, 3> order{0, 1, 2};  ///< vertex[i] was given as number order[i]
  ElementId source = 0;  ///< index of the element it was made from, in its model's list of that kind
};

/// Nothing beyond can be touched. A proxy of a metre still finds its way there, and no product of lengths that geometry
/// makes comes near the largest number.
inline constexpr double kFarthest_m = 1e9;
/// Whether a point is no farther, along any axis, from the origin; never for one that is not finite.
inline bool withinReach(const Vec3& p) { return (p.array().abs() <= kFarthest_m).all(); }

/// Whether the vertices make one: all within reach, and of some area or length. A triangle has none when its height
/// over the longest edge is below kSliver of that edge. RT-safe.
bool isTriangle(const Vec3& a, const Vec3& b, const Vec3& c);
bool isSegment(const Vec3& a, const Vec3& b);

/// The primitive that they make. RT-safe.
Primitive triangleOf(const Vec3& a, const Vec3& b, const Vec3& c, ElementId source);
Primitive segmentOf(const Vec3& a, const Vec3& b, ElementId source);
Primitive pointOf(const Vec3& a, ElementId source);

/// What an element of this kind makes of its corners (a segment's last is not looked at) wherever they have gone within
/// reach: a triangle that has shrunk to a line is its longest edge, and what has shrunk to a point is that. RT-safe.
Primitive shrunkenOf(PrimitiveKind kind, const std::array<Vec3, 3>& corners, ElementId source);

/// Both at once: each returns false, and leaves `out` alone, where the vertices make none.
bool makeTriangle(const Vec3& a, const Vec3& b, const Vec3& c, ElementId source, Primitive& out);
bool makeSegment(const Vec3& a, const Vec3& b, ElementId source, Primitive& out);
bool makePoint(const Vec3& a, ElementId source, Primitive& out);

/// Below this ratio of height to longest edge the face normal of a triangle has fewer than five good digits.
inline constexpr double kSliver = 1e-11;

}  // namespace hl
