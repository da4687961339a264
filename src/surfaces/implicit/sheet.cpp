#include "surfaces/implicit/sheet.h"

#include <algorithm>

namespace hl {

Sheet::Sheet(const ImplicitFunction& function, std::size_t number, const SheetGrid& grid, double slack)
    : function_(&function), number_(number), grid_(grid), slack_(slack) {
  const std::uint64_t most = *std::max_element(grid.cells.begin(), grid.cells.end());
  while (BrickPyramid::cells(levels_ - 1) < most) ++levels_;
}

Box Sheet::boxOf(int level, const Place& at) const {
  const double size = level < 0 ? grid_.step : grid_.step * static_cast<double>(BrickPyramid::cells(level));
  const Vec3 first = grid_.origin + size * Vec3(at[0], at[1], at[2]);
  return {first, first + Vec3::Constant(size)};
}

IsoCell Sheet::cellAt(const Place& at) const {
  std::array<Lanes, 3> corners;
  for (unsigned c = 0; c < kCellCorners; ++c) {
    const Vec3 p = grid_.at(Vec3(at[0] + (c & 1U), at[1] + (c >> 1U & 1U), at[2] + (c >> 2U & 1U)));
    for (std::size_t axis = 0; axis < 3; ++axis) corners[axis].of[c] = p[static_cast<Eigen::Index>(axis)];
  }
  const Lanes value = smooth().at(corners);
  IsoCell cell;
  cell.at = at;
  for (unsigned c = 0; c < kCellCorners; ++c) cell.value[c] = -value.of[c];
  findTriangles(cell);
  return cell;
}

std::array<Vec3, 3> Sheet::corners(const IsoCell& cell, unsigned triangle) const {
  std::array<Vec3, 3> result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = grid_.at(crossing(cell, cell.triangles->edges[triangle][i]));
  return result;
}

}  // namespace hl
