#include "surfaces/iso_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

namespace {

// Of an edge of a cell: a surface that crosses it as near to its end goes through that end, so that no triangle is a
// sliver. Of a cell of 1 mm, a picometre.
constexpr double kAtEnd = 0x1p-30;

}  // namespace

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
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (double& value : cell.value) {
    value = inward_ * (value - iso_.value);
    sum += value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low < 0 && high >= 0 && !std::isnan(sum)) cell.triangles = &trianglesOfCell(cell.value);
  return cell;
}

// In samples. The same bits in all cells that share the edge: its two values, from its begin to its end.
Vec3 IsoCells::crossing(const IsoCell& cell, unsigned edge) const {
  if (edge == kMiddle) return middleOf(cell);
  const unsigned begin = beginOfEdge(edge);
  const double first = cell.value[begin], last = cell.value[endOfEdge(edge)];
  double part = first / (first - last);
  if (part < kAtEnd) part = 0;
  if (part > 1 - kAtEnd) part = 1;
  Vec3 place(cell.at[0] + (begin & 1U), cell.at[1] + (begin >> 1U & 1U), cell.at[2] + (begin >> 2U & 1U));
  place[static_cast<Eigen::Index>(edge / 4)] += part;
  return place;
}

Vec3 IsoCells::middleOf(const IsoCell& cell) const {
  Vec3 sum = Vec3::Zero();
  int corners = 0;
  for (unsigned n = 0; n < cell.triangles->count; ++n) {
    const auto& edges = cell.triangles->edges[n];
    if (edges[2] != kMiddle) continue;
    sum += crossing(cell, edges[0]);
    ++corners;
  }
  return sum / corners;
}

bool IsoCells::exists(const IsoCell& cell, unsigned triangle) const {
  const auto& edges = cell.triangles->edges[triangle];
  const Vec3 a = crossing(cell, edges[0]), b = crossing(cell, edges[1]), c = crossing(cell, edges[2]);
  return a != b && b != c && c != a;
}

}  // namespace hl
