// HeightCell: a triangle of a grid of heights, by its cell.
#pragma once

#include <cstdint>

#include "geometry/element_id.h"

namespace hl {

/// The cell with its first sample at (column, row), and which of its triangles: 0 has its last corner in the next
/// column, 1 in the next row. Both have the corner of the cell and the one opposite, so the diagonal is always the
/// same.
struct HeightCell {
  std::uint32_t column, row;
  unsigned half;
};

/// `columns`: samples in a row of the grid. RT-safe.
inline ElementId idOf(const HeightCell& cell, std::uint32_t columns) {
  return 2 * (ElementId{cell.row} * (columns - 1) + cell.column) + cell.half;
}

/// The inverse. RT-safe.
inline HeightCell cellOf(ElementId id, std::uint32_t columns) {
  const ElementId cell = id / 2, cells = columns - 1;
  return {static_cast<std::uint32_t>(cell % cells), static_cast<std::uint32_t>(cell / cells),
          static_cast<unsigned>(id % 2)};
}

}  // namespace hl
