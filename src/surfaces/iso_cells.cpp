#include "surfaces/iso_cells.h"

#include <cmath>
#include <sstream>

#include "base/error.h"

namespace hl {

// Bounds of bricks are float32.
Volume::Volume(VoxelGrid of) : grid(std::move(of)), pyramid(grid) {
  const ValueRange& range = pyramid.range();
  if (!(range.low <= range.high) || (std::isfinite(range.low) && std::isfinite(range.high))) return;
  std::ostringstream text;
  text << "its scale (the slope of a NIfTI file) of " << grid.values().scale << " and offset of "
       << grid.values().offset << " take values beyond 3.4e38";
  throw Error(text.str());
}

ElementId IsoCells::count() const {
  const VoxelGrid& grid = volume_->grid;
  return kPerCell * grid.cells(0) * grid.cells(1) * grid.cells(2);
}

IsoCells::Place IsoCells::placeOf(ElementId id) const {
  const VoxelGrid& grid = volume_->grid;
  const ElementId cell = id / kPerCell, row = cell / grid.cells(0);
  return {static_cast<std::uint32_t>(cell % grid.cells(0)), static_cast<std::uint32_t>(row % grid.cells(1)),
          static_cast<std::uint32_t>(row / grid.cells(1))};
}

ElementId IsoCells::idOf(const IsoCell& cell, unsigned triangle) const {
  const VoxelGrid& grid = volume_->grid;
  return kPerCell * ((ElementId{cell.at[2]} * grid.cells(1) + cell.at[1]) * grid.cells(0) + cell.at[0]) + triangle;
}

IsoCell IsoCells::at(const Place& place) const {
  IsoCell cell{place, volume_->grid.cornersOf(place[0], place[1], place[2]), nullptr};
  for (double& value : cell.value) value = inward_ * (value - iso_.value);
  findTriangles(cell);
  return cell;
}

}  // namespace hl
