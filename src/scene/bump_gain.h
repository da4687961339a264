// The stiffness that a bump map adds to the servo, and the limit set by the device's damping.
//
// A height h under a normal force f turns the force by f grad h, so along the surface the force changes by f h'' per
// metre: the map acts as a spring of f h'' N/m. A sampled spring k is passive on a device with damping b if b >= k T /
// 2 (the same bound as for a wall), so f must stay below 2 b / (T h'').
#pragma once

#include "scene/snapshot.h"

namespace hl {

/// Whether an image has a slope somewhere along u or v, of those that `along` is not 0 for: that of
/// Texture::gradient(), as the tick has it. An image whose texels differ may have none. Linear in texels where there is
/// none, else it ends with the first row that has one.
bool hasSlope(const Texture& texture, const Vec2& along);

/// The largest change of the slope that a material's bump map is felt with, over the triangles that use it, 1/m; 0
/// without a map. For h = A sin(2 pi x / w) it is A (2 pi / w)^2, less what Texture::gradient() leaves out. Where
/// triangles stretch or shear the map in different ways it is an upper bound. Linear in texels and triangles; not for
/// real-time threads.
double bumpCurvature_per_m(const Snapshot& snapshot, std::size_t material);

/// The normal force, N, up to which a bump map of this curvature is passive.
inline double passiveForce_N(double curvature_per_m, double damping_Ns_m, double period_s) {
  return 2 * damping_Ns_m / (period_s * curvature_per_m);
}

}  // namespace hl
