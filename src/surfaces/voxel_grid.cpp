#include "surfaces/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace hl {

void checkVoxelSides(const std::array<std::uint32_t, 3>& side) {
  const auto [least, most] = std::minmax_element(side.begin(), side.end());
  if (*least < 2 || *most > kMaxVoxelSide) throw Error("a volume needs 2 to 2^20 samples along each axis");
}

VoxelGrid::VoxelGrid(const std::array<std::uint32_t, 3>& side, Samples samples, const ValueScale& values)
    : side_(side), samples_(std::move(samples)), values_(values) {
  checkVoxelSides(side);
  if (!std::isfinite(values.scale) || !std::isfinite(values.offset) || values.scale == 0)
    throw Error("the scale of a volume's values must be a number that is not 0, and their offset a number");
}

}  // namespace hl
