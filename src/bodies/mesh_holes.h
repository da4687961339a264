// Mesh holes: where the mesh of a piece is open, and caps that close it. What an open mesh holds depends on the origin
// of the integral; with the caps it does not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bodies/piece_mesh.h"

namespace hl {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;  ///< numbers of vertices, from and to

/// That no triangle passes the other way, ascending; each as often as such a triangle lacks. None: it is closed.
std::vector<DirectedEdge> openEdges(std::span<const Corners> triangles);

/// A mesh with its holes closed: of each a fan about the mean of its edge. Vertices that are equal but for rounding are
/// one. Of a mesh that is closed, to the bit, it is the mesh.
struct CappedMesh {
  std::vector<Vec3> vertices;
  std::vector<Corners> triangles;  ///< those of the mesh and of the caps
  std::size_t open_edges = 0;      ///< of all holes that have an area: of cracks the edges do not count
  double mesh_m2 = 0, caps_m2 = 0;

  /// Whether it is a shell with air on both sides: its holes are more than a small part of it. It does not matter where
  /// they are, nor how many.
  bool isShell() const {
    constexpr double kOpen = 0.05;
    return caps_m2 > kOpen * mesh_m2;
  }
};
CappedMesh capped(const PieceMesh& mesh);

}  // namespace hl
