// IsoCell: a cell of a grid that a surface of equal value crosses, and the corners of its triangles in grid steps. The
// values at its corners may be stored samples or computed.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "surfaces/marching_cell.h"

namespace hl {

struct IsoCell {
  std::array<std::uint32_t, 3> at{};         ///< its first corner
  std::array<double, kCellCorners> value{};  ///< at its corners, relative to the iso value: inside is >= 0
  const CellTriangles* triangles = nullptr;  ///< null: no value may be missing, and not all are on one side
};

/// Sets the triangles by the values. RT-safe.
void findTriangles(IsoCell& cell);
/// In grid steps: where the surface crosses an edge of the cell, or kMiddle. The same bits in all cells that share the
/// edge. RT-safe.
Vec3 crossing(const IsoCell& cell, unsigned edge);

/// The corners of a cell's triangles, each computed once. RT-safe.
class CellVertices {
 public:
  /// In grid steps.
  explicit CellVertices(const IsoCell& cell);
  /// Elsewhere.
  template <typename Map>
  CellVertices(const CellVertices& of, const Map& map) : used_(of.used_) {
    for (unsigned edge = 0; edge < at_.size(); ++edge) {
      if ((used_ >> edge & 1U) != 0) at_[edge] = map(of.at_[edge]);
    }
  }

  /// Of one of the cell's triangles.
  std::array<Vec3, 3> operator[](const std::array<std::uint8_t, 3>& edges) const {
    return {at_[edges[0]], at_[edges[1]], at_[edges[2]]};
  }

 private:
  std::array<Vec3, kCellEdges + 1> at_;  // by edge, or kMiddle
  unsigned used_ = 0;                    // a bit each
};

/// Whether the corners of a triangle are three: where a corner of a cell lies on the surface, some are not. RT-safe.
inline bool exists(const std::array<Vec3, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  return a != b && b != c && c != a;
}
/// Of the triangle of this number. RT-safe.
bool exists(const IsoCell& cell, unsigned triangle);

}  // namespace hl
