#include "io/volume_frame.h"

#include <fmt/core.h>

#include <cmath>

#include "base/error.h"
#include "surfaces/voxel_grid.h"

namespace hl {

std::array<std::uint32_t, 3> volumeSides(const std::array<double, 3>& counts) {
  std::array<std::uint32_t, 3> side{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double count = counts[axis];
    if (!(count >= 2 && count <= kMaxVoxelSide && count == std::floor(count)))
      throw Error(fmt::format("has {:g} x {:g} x {:g} samples: a volume has 2 to {} along each axis", counts[0],
                              counts[1], counts[2], kMaxVoxelSide));
    side[axis] = static_cast<std::uint32_t>(count);
  }
  return side;
}

std::uint64_t samplesIn(const std::array<std::uint32_t, 3>& side) { return std::uint64_t{side[0]} * side[1] * side[2]; }

Mat3 fromPatient(const Mat3& axes) {
  Mat3 turned;
  turned.row(0) = axes.row(0);
  turned.row(1) = axes.row(2);
  turned.row(2) = -axes.row(1);
  return turned;
}

bool spansSpace(const Mat3& axes) {
  constexpr double kShortest_m = 1e-10, kLongest_m = 1e4, kFlattest = 1e-4;
  double product = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double length = axes.col(axis).norm();
    if (!(length >= kShortest_m && length <= kLongest_m)) return false;
    product *= length;
  }
  return std::abs(axes.determinant()) >= kFlattest * product;
}

GridFrame centredFrame(const std::array<std::uint32_t, 3>& side, const Mat3& axes) {
  if (!spansSpace(axes)) throw Error("says no distances and directions between its samples that could be");
  const Vec3 middle(0.5 * (side[0] - 1.0), 0.5 * (side[1] - 1.0), 0.5 * (side[2] - 1.0));
  return {axes, -(axes * middle)};
}

}  // namespace hl
