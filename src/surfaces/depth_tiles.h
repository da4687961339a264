// DepthTiles: least and greatest depths of a depth image over tiles of pixels, and over tiles of tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surfaces/depth_camera.h"
#include "surfaces/depth_pixels.h"
#include "surfaces/depth_rows.h"

namespace hl {

/// Immutable; read by any thread. Level 0 has tiles of kCells x kCells cells; each tile of a higher level has kTiles x
/// kTiles of the level beneath. The last level is one tile.
class DepthTiles {
 public:
  static constexpr std::uint32_t kCells = 8, kTiles = 4;
  static constexpr int kMaxLevels = 15;  // kCells * kTiles^14 > kMaxGridSide

  /// In O(pixels), on all threads of oneTBB; the result does not depend on their number. Setup only.
  DepthTiles(const DepthPixels& pixels, const DepthCamera& camera);

  int levels() const { return static_cast<int>(levels_.size()); }
  std::uint32_t columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }
  std::uint32_t rows(int level) const { return levels_[static_cast<std::size_t>(level)].rows; }
  /// Cells along a side of a tile.
  static std::uint64_t side(int level) { return std::uint64_t{kCells} << (2 * level); }
  const DepthRange& range(int level, std::uint32_t column, std::uint32_t row) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    return of.ranges[std::size_t{row} * of.columns + column];
  }
  const DepthRange& all() const { return levels_.back().ranges.front(); }
  std::uint64_t triangles() const { return triangles_; }
  std::size_t bytes() const;

 private:
  struct Level {
    std::uint32_t columns, rows;
    std::vector<DepthRange> ranges;
  };
  void measure(const DepthPixels& pixels, const DepthCamera& camera);
  static Level above(const Level& in);

  std::vector<Level> levels_;
  std::uint64_t triangles_ = 0;
};

}  // namespace hl
