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
/// Whether triangle number `triangle` of the cell has an area: where a corner lies on the surface, some do not.
/// RT-safe.
bool exists(const IsoCell& cell, unsigned triangle);

}  // namespace hl
