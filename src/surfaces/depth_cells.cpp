#include "surfaces/depth_cells.h"

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
  return isTriangle(pointAt(at[0]), pointAt(at[1]), pointAt(at[2]));
}

}  // namespace hl
