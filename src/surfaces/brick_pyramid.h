// BrickPyramid: bounds of the values of a volume, over bricks of cells and over bricks of bricks: where a surface of
// equal value cannot be.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "base/fixed_vector.h"
#include "base/huge_pages.h"
#include "surfaces/voxel_grid.h"

namespace hl {

/// Calls visit(place) for those from `first` to before `end` along each axis, along x first.
template <typename Visit>
void forEachPlace(const std::array<std::uint32_t, 3>& first, const std::array<std::uint32_t, 3>& end,
                  const Visit& visit) {
  for (std::uint32_t z = first[2]; z < end[2]; ++z) {
    for (std::uint32_t y = first[1]; y < end[1]; ++y) {
      for (std::uint32_t x = first[0]; x < end[0]; ++x) visit({x, y, z});
    }
  }
}

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
    if (range().holds(value)) visitHolding(levels() - 1, {0, 0, 0}, value, visit);
  }
  /// About how many bricks of level 0 may hold `value`; 0 only where none does. RT-safe.
  std::uint64_t countHolding(double value) const;
  /// The largest of reach(first, end) over the bricks of level 0 that may hold `value`; minus infinity: there is none.
  /// `reach` is not less for a box of cells that encloses another. A few bricks of each level are looked at: those that
  /// may reach farther than what is found, until it is as far as slices of bricks let it be.
  template <typename Reach>
  double farthestHolding(double value, const Reach& reach) const {
    double best = -std::numeric_limits<double>::infinity();
    if (const auto [first, end] = regionHolding(value); first[0] < end[0])
      findFarther(levels() - 1, {0, 0, 0}, value, reach, reach(first, end), best);
    return best;
  }
  std::size_t bricks() const;  ///< of all levels
  std::size_t bytes() const;

 private:
  using Place = std::array<std::uint32_t, 3>;
  struct Level {
    std::array<std::uint32_t, 3> side;
    HugeVector<ValueRange> ranges;
  };
  static Level emptyLevel(const std::array<std::uint32_t, 3>& side);
  static Level overSamples(const VoxelGrid& grid);
  static Level above(const Level& beneath);
  void countRanges();
  void measureSlices();
  std::size_t binOf(double value) const;

  /// From the first to before the end, along each axis.
  struct Region {
    Place first, end;
  };
  // The cells of all slices of bricks that may hold a value.
  Region regionHolding(double value) const;
  // The cells of a brick.
  Region cellsIn(int level, const Place& at) const {
    Region region{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      region.first[axis] = static_cast<std::uint32_t>(at[axis] * cells(level));
      region.end[axis] =
          static_cast<std::uint32_t>(std::min<std::uint64_t>(region.first[axis] + cells(level), cells_[axis]));
    }
    return region;
  }
  // Calls visit(place) for the parts of a brick of level 1 or more that may hold the value.
  template <typename Visit>
  void forEachPartHolding(int level, const Place& at, double value, const Visit& visit) const {
    Place first{}, end{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = at[axis] * kBricks;
      end[axis] = std::min(first[axis] + kBricks, side(level - 1, axis));
    }
    forEachPlace(first, end, [&](const Place& part) {
      if (range(level - 1, part[0], part[1], part[2]).holds(value)) visit(part);
    });
  }
  template <typename Visit>
  void visitHolding(int level, const Place& at, double value, const Visit& visit) const {
    if (level == 0) {
      const auto [first, end] = cellsIn(level, at);
      return visit(first, end);
    }
    forEachPartHolding(level, at, value, [&](const Place& part) { visitHolding(level - 1, part, value, visit); });
  }

  // Looks at the parts of a brick that holds the value, those that reach farthest first; none reaches beyond `most`.
  template <typename Reach>
  void findFarther(int level, const Place& at, double value, const Reach& reach, double most, double& best) const {
    const auto reach_of = [&](int of, const Place& place) {
      const auto [first, end] = cellsIn(of, place);
      return reach(first, end);
    };
    if (level == 0) {
      best = std::max(best, reach_of(level, at));
      return;
    }
    FixedVector<std::pair<double, Place>, std::size_t{kBricks} * kBricks * kBricks> parts;
    forEachPartHolding(level, at, value, [&](const Place& part) { parts.push({reach_of(level - 1, part), part}); });
    std::sort(parts.begin(), parts.end(), std::greater<>());
    for (const auto& [farthest, part] : parts) {
      if (best >= std::min(farthest, most)) return;
      findFarther(level - 1, part, value, reach, most, best);
    }
  }

  Place cells_;  // of the grid, along each axis
  std::vector<Level> levels_;
  std::array<std::vector<ValueRange>, 3> slices_;  // of the bricks of level 0 with one place along an axis
  std::vector<std::uint32_t> holding_;  // bricks of level 0 that may hold a value, by parts of the range of all values
};

}  // namespace hl
