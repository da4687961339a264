// Expression: a solid that is written down: bodies of simple form, and what is made of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "geometry/box.h"

namespace hl {

enum class ExpressionKind : std::uint8_t {
  kSphere,        ///< radius
  kBox,           ///< size, radius of its rounded edges (0: sharp)
  kCylinder,      ///< radius, length along z
  kCapsule,       ///< radius, length of its axis along z
  kTorus,         ///< ring and tube; around z
  kHalfSpace,     ///< normal: outward, and distance of its plane from the origin along it
  kGyroid,        ///< period; thickness of a wall along the surface (0: the solid on one side)
  kUnion,         ///< of parts; smooth: reach of the blends
  kIntersection,  ///< the same
  kDifference,    ///< the first part without the others; the same
  kShell,         ///< wall of a thickness, half on each side of the surface of its part
  kOffset,        ///< its part grown by a distance
};

/// Lengths in metres, in a frame of its own: scaled, then turned about `axis`, then moved by `place`.
struct Expression {
  ExpressionKind kind = ExpressionKind::kSphere;
  double radius = 0, length = 0, ring = 0, period = 0, thickness = 0, distance = 0, smooth = 0;
  Vec3 size = Vec3::Zero(), normal = Vec3::UnitY();
  std::vector<Expression> parts;

  Vec3 axis = Vec3::UnitZ();
  double degrees = 0, scale = 1;
  Vec3 place = Vec3::Zero();
};

/// Limits of one expression.
inline constexpr std::size_t kMaxNodes = 1000, kMaxDepth = 24;
/// Of the smooth surfaces that it is made of, and of their bodies, counted once for each surface.
inline constexpr std::size_t kMaxSheets = 64, kMaxBodiesOfSheets = 256;

/// Throws hl::Error, which names the part ("union.of[1].sphere"), for one that cannot be.
void checkExpression(const Expression& expression);

Mat3 turnOf(const Expression& expression);

/// A box around it; none where it has no end.
std::optional<Box> boundsOf(const Expression& expression);

/// "sphere", "halfSpace" ...
const char* nameOf(ExpressionKind kind);

}  // namespace hl
