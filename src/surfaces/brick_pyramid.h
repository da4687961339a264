// BrickPyramid: bounds of the values of a volume, over bricks of cells and over bricks of bricks: where a surface of
// equal value cannot be.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/huge_pages.h"
#include "surfaces/voxel_grid.h"

namespace hl {

/// Empty if low > high: all samples are missing.
struct ValueRange {
  float low, high;

  bool holds(double value) const { return low <= value && value <= high; }
};

/// Immutable; read by any thread. Level 0 has bricks of kCells cells along each axis; each brick of a higher level has
/// kBricks of the level beneath along each axis. The last level is one brick.
class BrickPyramid {
 public:
  static constexpr std::uint32_t kCells = 4, kBricks = 4;

  /// In O(samples), on all threads of oneTBB; the result does not depend on their number. Setup only.
  explicit BrickPyramid(const VoxelGrid& grid);

  int levels() const { return static_cast<int>(levels_.size()); }
  /// Bricks of a level along an axis. RT-safe.
  std::uint32_t side(int level, std::size_t axis) const { return levels_[static_cast<std::size_t>(level)].side[axis]; }
  /// Cells along a side of a brick. RT-safe.
  static std::uint64_t cells(int level) { return std::uint64_t{kCells} << (2 * level); }
  /// Of all samples at the corners of its cells. RT-safe.
  const ValueRange& range(int level, std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    return of.ranges[(std::size_t{z} * of.side[1] + y) * of.side[0] + x];
  }
  /// Of the whole volume.
  const ValueRange& range() const { return levels_.back().ranges.front(); }
  /// Calls visit(first, end) for each brick of level 0 that may hold `value`: its cells along each axis.
  template <typename Visit>
  void forEachHolding(double value, const Visit& visit) const {
    holding(levels() - 1, {0, 0, 0}, value, visit);
  }
  std::size_t bricks() const;  ///< of all levels
  std::size_t bytes() const { return sizeof(*this) + bricks() * sizeof(ValueRange); }

 private:
  using Place = std::array<std::uint32_t, 3>;
  struct Level {
    std::array<std::uint32_t, 3> side;
    HugeVector<ValueRange> ranges;
  };
  static Level emptyLevel(const std::array<std::uint32_t, 3>& side);
  static Level overSamples(const VoxelGrid& grid);
  static Level above(const Level& beneath);

  template <typename Visit>
  void holding(int level, const Place& at, double value, const Visit& visit) const {
    if (!range(level, at[0], at[1], at[2]).holds(value)) return;
    Place first{}, end{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = at[axis] * (level == 0 ? kCells : kBricks);
      const std::uint32_t most = level == 0 ? cells_[axis] : side(level - 1, axis);
      end[axis] = std::min(first[axis] + (level == 0 ? kCells : kBricks), most);
    }
    if (level == 0) return visit(first, end);
    for (std::uint32_t z = first[2]; z < end[2]; ++z) {
      for (std::uint32_t y = first[1]; y < end[1]; ++y) {
        for (std::uint32_t x = first[0]; x < end[0]; ++x) holding(level - 1, {x, y, z}, value, visit);
      }
    }
  }

  Place cells_;  // of the grid, along each axis
  std::vector<Level> levels_;
};

}  // namespace hl
