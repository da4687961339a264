// Plane cuts: a surface of triangles, cut by a plane into two.
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"
#include "bodies/half_space.h"

namespace hl {

using Triangle3 = std::array<Vec3, 3>;  ///< counterclockwise, seen from outside
using CutSurface = std::vector<Triangle3>;

/// What is at or above the plane. What lies in it, to within `rounding` (m), goes to the side of the matter that it
/// bounds.
CutSurface above(const CutSurface& surface, const HalfSpace& plane, double rounding);

}  // namespace hl
