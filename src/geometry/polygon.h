// Polygons, which need not be convex, cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace hl {

/// The triangles of a polygon, as numbers of its corners: two fewer than it has corners, and turning as it does.
/// A simple polygon is covered once. Its hole may be joined to its outline by an edge that is walked twice. Of a
/// polygon that crosses itself the triangles are some that have its outline. The corners are flattened along one axis.
std::vector<std::array<std::uint32_t, 3>> trianglesOf(std::span<const Vec3> corners);

}  // namespace hl
