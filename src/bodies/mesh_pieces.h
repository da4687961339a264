// Mesh pieces: the solids that a mesh consists of, distinguished by its triangles alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace hl {

/// Numbers of triangles of each piece, ascending; pieces in the order of their first triangle. Corners at the same
/// place, to the bit, are one vertex. A surface that is closed before the next one begins in the list is a piece by
/// itself; of others, triangles that meet at an edge are of one piece. Where more than two meet, those are that have
/// the inside of a solid between them: so boxes side by side, with all corners of a face in common, are pieces of their
/// own in whatever order their triangles come. The winding says where the inside is; all of it may be turned round.
/// Triangles without area are left out.
std::vector<std::vector<std::uint32_t>> piecesOf(std::span<const Vec3> vertices,
                                                 std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace hl
