// Patches as one mesh. Sides with the same control points and weights are divided alike, whichever way they go, so that
// their vertices are the same to the bit and there are no cracks. Each vertex has the normal of its own surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/nurbs_patch.h"

namespace hl {

struct PatchMesh {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> texcoords;  ///< where on its patch, 0..1 each
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double error_m = 0;  ///< bound of the distance between the triangles and the patches
};

/// Of the largest side of all control points: what a mesh is exact to where nothing else is said.
inline constexpr double kPatchError = 2e-5;
inline constexpr std::uint64_t kMaxPatchTriangles = 5'000'000;
/// Bezier pieces of all patches together.
inline constexpr std::uint64_t kMaxPatchPieces = 20'000;

/// How each piece is divided.
struct PatchPlan {
  struct Piece {
    std::size_t patch, i, j;  ///< of the patch's net
    std::uint32_t n_u, n_v;   ///< cells
  };
  std::vector<BezierNet> nets;
  std::vector<Piece> pieces;
  std::uint64_t triangles = 0;  ///< two for each cell
  std::uint64_t vertices = 0;
  double error_m = 0;
};

/// `error_m` = 0: kPatchError of the size. Throws hl::Error for patches that make no surface, and if there were more
/// than `most_triangles`. Takes memory for the pieces alone.
PatchPlan planPatches(const std::vector<NurbsPatch>& patches, double error_m = 0,
                      std::uint64_t most_triangles = kMaxPatchTriangles);

PatchMesh meshPatches(const PatchPlan& plan);

}  // namespace hl
