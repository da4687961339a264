#include "surfaces/depth_tiles.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace hl {

namespace {

using Rows = oneapi::tbb::blocked_range<std::uint32_t>;
constexpr float kNoDepth = std::numeric_limits<float>::infinity();
constexpr DepthRange kNoRange{kNoDepth, -kNoDepth};

std::uint32_t tilesFor(std::uint32_t parts, std::uint32_t per_tile) { return (parts + per_tile - 1) / per_tile; }

}  // namespace

DepthTiles::DepthTiles(const DepthPixels& pixels, const DepthCamera& camera) {
  measure(pixels, camera);
  while (levels_.back().ranges.size() > 1) levels_.push_back(above(levels_.back()));
}

void DepthTiles::measure(const DepthPixels& pixels, const DepthCamera& camera) {
  const std::uint32_t rows_of_cells = pixels.rows() - 1;
  Level level{tilesFor(pixels.columns() - 1, kCells), tilesFor(rows_of_cells, kCells), {}};
  level.ranges.resize(std::size_t{level.columns} * level.rows);
  triangles_ = oneapi::tbb::parallel_reduce(
      Rows(0, level.rows), std::uint64_t{0},
      [&](const Rows& rows, std::uint64_t triangles) {
        for (std::uint32_t row = rows.begin(); row < rows.end(); ++row) {
          const std::uint32_t first = row * kCells;
          const CellBand band{pixels.row(first), pixels.columns(), std::min(kCells, rows_of_cells - first)};
          triangles += boundCells(band, static_cast<float>(camera.join), kCells,
                                  level.ranges.data() + std::size_t{row} * level.columns);
        }
        return triangles;
      },
      std::plus<>());
  levels_.push_back(std::move(level));
}

DepthTiles::Level DepthTiles::above(const Level& in) {
  Level out{tilesFor(in.columns, kTiles), tilesFor(in.rows, kTiles), {}};
  out.ranges.assign(std::size_t{out.columns} * out.rows, kNoRange);
  for (std::uint32_t row = 0; row < in.rows; ++row) {
    for (std::uint32_t column = 0; column < in.columns; ++column) {
      const DepthRange& part = in.ranges[std::size_t{row} * in.columns + column];
      DepthRange& whole = out.ranges[std::size_t{row / kTiles} * out.columns + column / kTiles];
      whole.low = std::min(whole.low, part.low);
      whole.high = std::max(whole.high, part.high);
    }
  }
  return out;
}

std::size_t DepthTiles::bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const Level& level : levels_) bytes += level.ranges.capacity() * sizeof(DepthRange);
  return bytes;
}

}  // namespace hl
