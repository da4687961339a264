#include "vdb/read_vdb.h"

#include <fmt/core.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "io/text_words.h"
#include "io/volume_frame.h"

namespace hl {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

Vec3 vecOf(const openvdb::Vec3d& v) { return {v.x(), v.y(), v.z()}; }

// Column i leads from a voxel to the next one along axis i, m.
Mat3 axesOf(const openvdb::math::Transform& transform) {
  const Vec3 origin = vecOf(transform.indexToWorld(openvdb::Vec3d(0, 0, 0)));
  Mat3 axes;
  for (int axis = 0; axis < 3; ++axis) {
    openvdb::Vec3d step(0, 0, 0);
    step[axis] = 1;
    axes.col(axis) = vecOf(transform.indexToWorld(step)) - origin;
  }
  return axes;
}

std::array<std::uint32_t, 3> sidesOf(const CoordBBox& box) {
  std::array<double, 3> counts{};
  for (int axis = 0; axis < 3; ++axis)
    counts[static_cast<std::size_t>(axis)] = static_cast<double>(box.max()[axis]) - box.min()[axis] + 1;
  return volumeSides(counts);
}

// With what is around the active voxels, so that a closed surface is closed.
CoordBBox boxOf(const FloatGrid& grid) {
  constexpr int kFarthest = 1 << 30;
  CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) throw Error(fmt::format("has nothing in its grid '{}'", shown(grid.getName())));
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min()[axis] < -kFarthest || box.max()[axis] > kFarthest)
      throw Error(fmt::format("is not a sound file: its grid '{}' has voxels out of reach", shown(grid.getName())));
  }
  box.expand(1);
  return box;
}

// All of the box is kept. A voxel far from the others, as a broken file has it, must not take gigabytes.
void checkFilling(const FloatGrid& grid, const std::array<std::uint32_t, 3>& side) {
  constexpr std::uint64_t kSmall = std::uint64_t{1} << 26, kMaxForEach = 2000;
  // A level set has single voxels alone; fog has whole blocks of one value, too.
  const bool single = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  const std::uint64_t active = single ? grid.tree().activeLeafVoxelCount() : grid.activeVoxelCount();
  const std::uint64_t all = samplesIn(side);
  if (all <= kSmall || all / kMaxForEach <= active) return;
  throw Error(fmt::format(
      "has {} active voxels in a box of {} x {} x {}, which would take {:.1f} GB: some lie far from the others; remove "
      "these, or resample the grid '{}' to larger voxels",
      active, side[0], side[1], side[2], 1e-9 * sizeof(float) * static_cast<double>(all), shown(grid.getName())));
}

// What a walk over the voxels of a level set finds.
struct LevelSetLook {
  float least = std::numeric_limits<float>::infinity(), most = -least;
  std::size_t narrow = 0;   ///< voxels at the surface with another surface within two voxels
  std::size_t lacking = 0;  ///< voxels whose value is no number
};

// The gradient of distances has the length 1. It is shorter where those of two surfaces meet: by cos a on the bisector
// of an edge of 180 - 2 a degrees, and 0 in the middle of a wall or a gap.
constexpr double kNarrowSlope = 0.3;

LevelSetLook lookAt(const FloatGrid& grid, const Mat3& axes) {
  LevelSetLook look;
  const Vec3 steps = axes.colwise().norm();
  const auto near = static_cast<float>(steps.minCoeff());
  const bool wide = std::abs(grid.background()) > 2.5 * steps.maxCoeff();  // a band in which neighbours have distances
  const auto values = grid.getConstAccessor();
  for (auto at = grid.cbeginValueOn(); at; ++at) {
    const float value = *at;
    look.lacking += std::isnan(value) ? 1 : 0;
    look.least = std::min(look.least, value);
    look.most = std::max(look.most, value);
    if (!wide || !at.isVoxelValue() || std::abs(value) > near) continue;
    const Coord here = at.getCoord();
    double slope2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      Coord step(0, 0, 0);
      step[axis] = 1;
      const double rise = values.getValue(here + step) - values.getValue(here - step);
      slope2 += std::pow(rise / (2 * steps[axis]), 2);
    }
    if (slope2 < kNarrowSlope * kNarrowSlope) ++look.narrow;
  }
  return look;
}

void checkLevelSet(const FloatGrid& grid, const Mat3& axes, VolumeSink& sink) {
  const LevelSetLook look = lookAt(grid, axes);
  if (!(look.least < 0 && look.most > 0))
    throw Error(fmt::format("has no surface in its level set '{}': its distances are from {:.6g} to {:.6g}",
                            shown(grid.getName()), look.least, look.most));
  if (look.lacking > 0)
    sink.warn(fmt::format("has {} voxels in its level set that are no numbers: its surface is open around them",
                          look.lacking));
  if (look.narrow > 0)
    sink.warn(
        fmt::format("has walls or gaps that are thinner than two of its voxels, {:.3g} m, at {} of them: they "
                    "may be closed or torn",
                    2 * axes.colwise().norm().maxCoeff(), look.narrow));
}

// In pieces of whole rows, so that no more than a few megabytes of the box are here at once.
void giveSamples(const FloatGrid& grid, const CoordBBox& box, VolumeSink& sink) {
  constexpr std::int64_t kPiece = 1 << 20;  // samples
  using Piece = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;
  const int rows = static_cast<int>(std::max<std::int64_t>(1, kPiece / box.dim().x()));
  for (int z = box.min().z(); z <= box.max().z(); ++z) {
    for (int y = box.min().y(); y <= box.max().y(); y += rows) {
      const int last = std::min(y + rows - 1, box.max().y());
      Piece piece(CoordBBox(box.min().x(), y, z, box.max().x(), last, z));
      openvdb::tools::copyToDense(grid, piece, true);
      sink.samples(piece.data(), piece.valueCount() * sizeof(float));
    }
  }
}

}  // namespace

void giveVolume(const FloatGrid& grid, VolumeSink& sink) {
  if (!grid.transform().isLinear())
    throw Error(
        fmt::format("has its grid '{}' in the frustum of a camera: resample it to a box", shown(grid.getName())));
  const Mat3 axes = axesOf(grid.transform());
  if (!spansSpace(axes)) throw Error("is not a sound file: its transform has no extent");
  const CoordBBox box = boxOf(grid);
  VolumeHeader header;
  header.side = sidesOf(box);
  checkFilling(grid, header.side);
  header.kind = SampleKind::kFloat32;
  header.frame = {axes, vecOf(grid.indexToWorld(box.min()))};
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
    header.iso = IsoValue{0, SolidSide::kBelow};
    checkLevelSet(grid, axes, sink);
  }
  sink.header(header);
  giveSamples(grid, box, sink);
}

}  // namespace hl
