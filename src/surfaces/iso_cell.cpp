#include "surfaces/iso_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hl {

namespace {

// Of an edge of a cell: a surface that crosses it as near to its end goes through that end, so that no triangle is a
// sliver. Of a cell of 1 mm, a picometre.
constexpr double kAtEnd = 0x1p-30;

Vec3 middleOf(const IsoCell& cell) {
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

}  // namespace

void findTriangles(IsoCell& cell) {
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : cell.value) {
    sum += value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  cell.triangles = low < 0 && high >= 0 && !std::isnan(sum) ? &trianglesOfCell(cell.value) : nullptr;
}

// By the two values of the edge, from its begin to its end.
Vec3 crossing(const IsoCell& cell, unsigned edge) {
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

CellVertices::CellVertices(const IsoCell& cell) {
  for (unsigned n = 0; n < cell.triangles->count; ++n) {
    for (const std::uint8_t edge : cell.triangles->edges[n]) {
      if ((used_ >> edge & 1U) == 0) at_[edge] = crossing(cell, edge);
      used_ |= 1U << edge;
    }
  }
}

bool exists(const IsoCell& cell, unsigned triangle) {
  const auto& edges = cell.triangles->edges[triangle];
  return exists({crossing(cell, edges[0]), crossing(cell, edges[1]), crossing(cell, edges[2])});
}

}  // namespace hl
