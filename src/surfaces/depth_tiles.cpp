#include "surfaces/depth_tiles.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace hl {

namespace {

using Rows = oneapi::tbb::blocked_range<std::uint32_t>;
constexpr float kNoDepth = std::numeric_limits<float>::infinity();
constexpr DepthRange kNoRange{kNoDepth, -kNoDepth};

std::uint32_t tilesFor(std::uint32_t parts, std::uint32_t per_tile) { return (parts + per_tile - 1) / per_tile; }

void extend(DepthRange& range, double low, double high) {
  // Rounded outward.
  range.low = std::min(range.low, std::nextafter(static_cast<float>(low), -kNoDepth));
  range.high = std::max(range.high, std::nextafter(static_cast<float>(high), kNoDepth));
}

// Of the cells from (column, row), up to `side` along each axis.
DepthRange rangeOf(const HeightGrid& grid, const DepthCamera& camera, std::uint32_t column, std::uint32_t row,
                   std::uint64_t& triangles) {
  DepthRange range = kNoRange;
  const std::uint32_t end = std::min(column + DepthTiles::kCells, grid.columns() - 1);
  const std::uint32_t bottom = std::min(row + DepthTiles::kCells, grid.rows() - 1);
  for (std::uint32_t j = row; j < bottom; ++j) {
    double a = grid.at(column, j), c = grid.at(column, j + 1);
    for (std::uint32_t i = column; i < end; ++i) {
      const double b = grid.at(i + 1, j), d = grid.at(i + 1, j + 1);
      if (camera.joins(a, d, b)) {
        extend(range, std::min({a, d, b}), std::max({a, d, b}));
        ++triangles;
      }
      if (camera.joins(a, c, d)) {
        extend(range, std::min({a, c, d}), std::max({a, c, d}));
        ++triangles;
      }
      a = b;
      c = d;
    }
  }
  return range;
}

}  // namespace

DepthTiles::DepthTiles(const HeightGrid& grid, const DepthCamera& camera) {
  measure(grid, camera);
  while (levels_.back().ranges.size() > 1) levels_.push_back(above(levels_.back()));
}

void DepthTiles::measure(const HeightGrid& grid, const DepthCamera& camera) {
  Level level{tilesFor(grid.columns() - 1, kCells), tilesFor(grid.rows() - 1, kCells), {}};
  level.ranges.resize(std::size_t{level.columns} * level.rows);
  triangles_ = oneapi::tbb::parallel_reduce(
      Rows(0, level.rows), std::uint64_t{0},
      [&](const Rows& rows, std::uint64_t triangles) {
        for (std::uint32_t row = rows.begin(); row < rows.end(); ++row) {
          for (std::uint32_t column = 0; column < level.columns; ++column)
            level.ranges[std::size_t{row} * level.columns + column] =
                rangeOf(grid, camera, column * kCells, row * kCells, triangles);
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
