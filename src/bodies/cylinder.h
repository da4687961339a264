// Cylinder: what is exact of a round shape, whose polytope is a prism (convex.h).
#pragma once

#include "bodies/placed_convex.h"

namespace hl {

/// World.
struct CylinderFrame {
  Vec3 middle, axis;
  double half_length;  ///< m
};
/// RT-safe.
CylinderFrame frameOf(const PlacedConvex& cylinder);

/// What of a prism is turned toward the other: an edge along the axis lies on a plane as a cylinder does; a side is the
/// tangent plane for a point that touches it.
enum class PrismTurn { kEdge, kSide };

/// The cylinder's prism, turned about the axis toward `direction` (world). RT-safe.
PlacedConvex turnedPrism(const PlacedConvex& cylinder, const Vec3& direction, PrismTurn turn, PlacedRoom& room);
/// Outward, across the axis, to the point; unchanged `otherwise` if the point lies on the axis. RT-safe.
Vec3 radialOf(const PlacedConvex& cylinder, const Vec3& point, const Vec3& otherwise);
}  // namespace hl
