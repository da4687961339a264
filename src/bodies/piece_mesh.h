// Piece mesh: one piece of a model's triangles, each place once, in an order that no order of its triangles changes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "geometry/box.h"
#include "scene/model.h"

namespace hl {

using Corners = std::array<std::uint32_t, 3>;  ///< of a triangle: numbers of vertices

struct PieceMesh {
  std::vector<Vec3> vertices;      ///< m, ascending
  std::vector<Corners> triangles;  ///< ascending, the least corner first; outward, where the piece is closed
  bool is_turned = false;          ///< it faced inward: all of the mesh does, or it is a hollow of it
  bool operator==(const PieceMesh&) const = default;
};

/// `piece`: numbers of triangles of the model (mesh_pieces.h).
PieceMesh pieceMesh(const Model& model, std::span<const std::uint32_t> piece);
Box boundsOf(const PieceMesh& mesh);
/// Half the diagonal of the bounds, m.
double sizeOf(const PieceMesh& mesh);

/// With at most so many triangles (>= 1): vertices in one cell of a grid become their mean, triangles that lose their
/// area are left out. None may be left.
PieceMesh coarseMesh(const PieceMesh& mesh, std::size_t most_triangles);

}  // namespace hl
