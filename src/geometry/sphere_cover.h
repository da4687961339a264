// Covers one primitive with small spheres by scan conversion (the paper's section 6.2). Internal to src/geometry.
#pragma once

#include "base/function_ref.h"
#include "geometry/primitive.h"

namespace hl {

/// At most this many spheres cover one primitive; a larger primitive gets larger spheres.
inline constexpr int kCoverMax = 64;

/// Smallest sphere that contains the primitive (of its vertices).
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};
Ball boundingBall(const Primitive& primitive);

/// Visits spheres of about `radius` (m) whose union contains the primitive; one sphere if the primitive fits into it.
void coverWithSpheres(const Primitive& primitive, double radius, FunctionRef<void(const Ball&)> visit);

}  // namespace hl
