// Mesh parts: the convex parts of a body that collides as the pieces of its mesh. A piece that is not convex becomes
// several (nearly_convex.h).
#pragma once

#include <vector>

#include "bodies/compound.h"
#include "bodies/mass.h"
#include "bodies/piece_mesh.h"
#include "scene/model.h"

namespace hl {

struct MeshParts {
  Compound shape;       ///< in the frame of the body: its origin is the centre
  Solid solid;          ///< the sum of the pieces: where two overlap, twice
  double error_m = 0;   ///< how far a point of the mesh is outside of all parts, at most
  double excess_m = 0;  ///< how far a part reaches beyond the mesh, at most
  /// Edges of holes, of all pieces that are open (mesh_holes.h).
  std::size_t open_edges = 0;
  double shell_m = 0;  ///< how thick those that are shells count for the mass; 0: none is
};

/// The pieces of a mesh (mesh_pieces.h), each once; of more than kMaxParts all together, as one.
std::vector<PieceMesh> meshesOfPieces(const Model& model);

/// Of half the diagonal of the mesh's bounds: a part may be so far from the mesh.
inline constexpr double kNearlyConvex = 0.02;

/// Of the triangles; lines and points of the model are no part. A part that lies in the hull of another is none. Of
/// more pieces than kMaxParts all together are cut. The error is at most kNearlyConvex of the mesh's size, unless that
/// needs more than kMaxParts. A piece has the mass of its mesh: of what that holds, with small holes closed; of a
/// shell (mesh_holes.h) of its area times 1 % of how far the whole mesh reaches from the middle of its surface; only if
/// it crosses itself that of its parts. So the mass of an open mesh does not depend on which part of it lacks, on how
/// it is cut, nor on its frame. A hollow, which faces the other way, is taken off. Throws Error, one line that says
/// what to do, if there is no triangle, or nothing but slivers.
MeshParts partsOfMesh(const Model& model);

}  // namespace hl
