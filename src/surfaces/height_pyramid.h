// HeightPyramid: bounds of the heights of a grid, over blocks of cells and over blocks of blocks. Each bound is a slab
// between two parallel planes, which follow the slope of the surface: on a smooth slope they are as close as on a
// plain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/huge_pages.h"
#include "surfaces/height_grid.h"

namespace hl {

/// Units of the samples. Every sample of the block lies between low and high plus slope * (steps from the first column
/// and row of the block). Empty if low > high: no cell of the block has triangles.
struct HeightSlab {
  float low, high;
  float slope_column, slope_row;  ///< per grid step

  bool empty() const { return low > high; }
};

/// Immutable; read by any thread. Level 0 has blocks of kCells x kCells cells; each block of a higher level has
/// kBlocks x kBlocks of the level beneath. The last level is one block.
class HeightPyramid {
 public:
  static constexpr std::uint32_t kCells = 8, kBlocks = 4;
  static constexpr int kMaxLevels = 15;  // kCells * kBlocks^14 > kMaxGridSide

  /// In O(samples), on all threads of oneTBB; the result does not depend on their number. Setup only.
  explicit HeightPyramid(const HeightGrid& grid);

  int levels() const { return static_cast<int>(levels_.size()); }
  /// Blocks of a level. RT-safe.
  std::uint32_t columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }
  std::uint32_t rows(int level) const { return levels_[static_cast<std::size_t>(level)].rows; }
  /// Cells along a side of a block. RT-safe.
  static std::uint64_t side(int level) { return std::uint64_t{kCells} << (2 * level); }
  /// RT-safe.
  const HeightSlab& slab(int level, std::uint32_t column, std::uint32_t row) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    return of.slabs[std::size_t{row} * of.columns + column];
  }
  std::uint64_t cells() const { return cells_; }  ///< that have triangles
  double lowest() const { return lowest_; }       ///< of the samples around such cells
  double highest() const { return highest_; }
  std::size_t bytes() const;

 private:
  struct Level {
    std::uint32_t columns, rows;
    HugeVector<HeightSlab> slabs;
  };
  void measure(const HeightGrid& grid);
  HeightSlab joined(int level, std::uint32_t column, std::uint32_t row, const GridSize& size) const;
  Level above(int level, const HeightGrid& grid) const;

  std::vector<Level> levels_;
  std::uint64_t cells_ = 0;
  double lowest_ = 0, highest_ = 0;
};

}  // namespace hl
