#include "surfaces/depth_cells.h"

#include <algorithm>
#include <cmath>

#include "geometry/primitive.h"

namespace hl {

std::array<DepthCells::Pixel, 3> DepthCells::pixelsOf(const HeightCell& cell) const {
  const std::uint32_t i = cell.column, j = cell.row;
  std::array<Pixel, 3> pixels{{{i, j}, {i + 1, j + 1}, {i + 1, j}}};
  if (cell.half == 1) pixels = {{{i, j}, {i, j + 1}, {i + 1, j + 1}}};
  if (mirrored_) std::swap(pixels[1], pixels[2]);
  return pixels;
}

std::array<Vec3, 3> DepthCells::corners(ElementId id) const {
  const std::array<Pixel, 3> at = pixelsOf(cellOf(id, pixels().columns()));
  return {pointAt(at[0]), pointAt(at[1]), pointAt(at[2])};
}

bool DepthCells::exists(const HeightCell& cell) const {
  const std::array<Pixel, 3> at = pixelsOf(cell);
  if (!image_->camera.joins(depthAt(at[0]), depthAt(at[1]), depthAt(at[2]))) return false;
  return plain_ || isTriangle(pointAt(at[0]), pointAt(at[1]), pointAt(at[2]));
}

double DepthCells::nearness(const HeightCell& cell, double column, double row) const {
  if (!exists(cell)) return 0;
  const double right = column - cell.column, down = row - cell.row, most = std::max(right, down);
  const Pixel beside = cell.half == 0 ? Pixel{cell.column + 1, cell.row} : Pixel{cell.column, cell.row + 1};
  return (1 - most) / depthAt({cell.column, cell.row}) + std::abs(right - down) / depthAt(beside) +
         std::min(right, down) / depthAt({cell.column + 1, cell.row + 1});
}

// Three pixels at depths d (1 + join) and less, along ways w = (x / z, y / z, 1), span a tetrahedron with the camera,
// of six volumes d^3 / (fx fy) or more, whose height is at most d |w|: twice its base is d^2 / (fx fy |w|) or more. An
// edge has at most the length d ((1 + join) (1 / fx + 1 / fy) + join |w|). Axes of the condition K make the base over
// the square of the edge, the height over the longest edge, less by at most K^2.
bool DepthCells::isPlain() const {
  constexpr double kEnough = 1e-6, kDigits = 1e-9;  // by far more than kSliver, and than rounding
  const DepthCamera& camera = image_->camera;
  const DepthRange& range = image_->tiles.all();
  if (range.empty()) return false;
  const double across = std::max(std::abs(camera.across(0)), std::abs(camera.across(pixels().columns())));
  const double down = std::max(std::abs(camera.down(0)), std::abs(camera.down(pixels().rows())));
  const double farthest = Vec3(across, down, 1).norm(), step = 1 / camera.fx + 1 / camera.fy;
  const double edge = (1 + camera.join) * step + camera.join * farthest;
  const double inverse = frame_.axes.inverse().norm(), condition = frame_.axes.norm() * inverse;
  const double least_edge = range.low / (std::max(camera.fx, camera.fy) * inverse);
  const double extent = frame_.origin.norm() + range.high * frame_.axes.norm() * farthest;
  return 1 / (camera.fx * camera.fy * farthest * edge * edge * condition * condition) > kEnough &&
         least_edge > kDigits * extent;
}

}  // namespace hl
