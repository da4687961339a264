// Solids: closed meshes of simple bodies, for scenes that are put together from them.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/model.h"

namespace hl {

/// Centred at the origin; flat faces. `half`: m, of the sides, > 0.
Model boxSolid(const Vec3& half);

/// A point of a profile: distance from the y axis and height, m.
struct ProfilePoint {
  double radius = 0, height = 0;
};
/// The profile turned about the y axis in `sides` >= 3 parts. From the bottom to the top, outside on its right; ends
/// that are on the axis close it. Smooth around the axis; along the profile too if `smooth`, else each part is a cone
/// with edges.
Model turnedSolid(const std::vector<ProfilePoint>& profile, std::size_t sides, bool smooth);

/// Centred at the origin; `radius` in m; smooth.
Model ballSolid(double radius, std::size_t sides);
/// Along y, centred, of wedges (>= 3) that are solids of their own; flat faces.
Model ringSolid(double inner, double outer, double half_height, std::size_t wedges);
/// Along y, centred.
Model cylinderSolid(double radius, double half_height, std::size_t sides);

/// Puts the vertices and triangles of `part` into `whole`, moved by `at`. Both have normals, and one material.
void appendSolid(Model& whole, Model part, const Vec3& at);

}  // namespace hl
