// Parametric test surfaces of about N triangles, y up, 0.2 m across, with exact normals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "scene/model.h"

namespace hl {

/// A grid of nu x nv cells, two triangles each, of a surface over (u, v) in 0..1. Normals by central differences of the
/// surface, on the side of dP/du x dP/dv. Triangles without area (at poles) are left out.
Model makeSurface(std::uint32_t nu, std::uint32_t nv, const std::function<Vec3(double u, double v)>& surface);

Model makeTerrain(std::size_t triangles);      ///< smooth hills, 30 mm from valley to peak
Model makeBumpySphere(std::size_t triangles);  ///< radius 0.1 m with bumps of 4 mm
Model makePlane(std::size_t triangles);        ///< y = 0
Model makePits(std::size_t triangles);         ///< 10 x 10 inverted pyramids, 20 mm wide and deep, slopes of 45 degrees
Model makeHalfPipe(std::size_t triangles);     ///< concave upward, radius 0.1 m

}  // namespace hl
