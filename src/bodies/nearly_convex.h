// Nearly convex: a solid that is not convex, as hulls that together nearly are it.
#pragma once

#include <algorithm>
#include <vector>

#include "bodies/convex_hull.h"
#include "bodies/piece_mesh.h"

namespace hl {

struct NearlyConvex {
  std::vector<Hull> hulls;
  double excess_m = 0;   ///< how far a hull reaches beyond the mesh, at most
  double outside_m = 0;  ///< how far one is outside of all of them
  double error_m() const { return std::max(excess_m, outside_m); }
};

/// Of what has more triangles, where to cut is found from a coarse mesh of it; the hulls hold all vertices.
inline constexpr std::size_t kCoarseTriangles = 3000;

/// One hull, if its error is at most `allowed_m` (> 0). Otherwise about as few as come up to that, or `most` (> 0) of
/// them, which do not (convex_cuts.h). An open surface, such as a bowl without thickness, is a shell with air on both
/// sides; its parts, and others that are flat, get a thickness of half of what is allowed, inward. Small holes do not
/// make a shell. Both errors are measured at corners, middles of edges and of triangles, at most some thousand of them.
/// Throws Error if the mesh has no triangle with an area. Remembers what it has made: it is asked again for each frame
/// of a scene. Takes up to seconds; setup only, by any thread.
NearlyConvex nearlyConvex(const PieceMesh& mesh, double allowed_m, std::size_t most);

}  // namespace hl
