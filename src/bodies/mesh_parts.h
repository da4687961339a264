// Mesh parts: the convex parts of a body that collides as the pieces of its mesh, each as its convex hull.
#pragma once

#include <vector>

#include "bodies/compound.h"
#include "bodies/mass.h"
#include "scene/model.h"

namespace hl {

struct MeshParts {
  Compound shape;      ///< in the frame of the body: its origin is the centre
  Solid solid;         ///< the sum of the parts: where two overlap, twice
  double error_m = 0;  ///< of the worst hull (convex_hull.h)
};

/// The corners of each piece (mesh_pieces.h), each place once, in an order that no order of triangles changes.
std::vector<std::vector<Vec3>> cornersOfPieces(const Model& model);

/// Of the triangles; lines and points of the model are no part. A piece that lies in the hull of another is none
/// either. Throws Error, one line that says what to do, for a piece without a thickness, and for none or more than
/// kMostParts.
MeshParts partsOfMesh(const Model& model);

}  // namespace hl
