// DepthWalk: from the tiles of a depth image to the triangles that a moving ball may touch.
//
// In grid coordinates q = (x / z depth, y / z depth, depth) of the camera the box around the ball on its way gives the
// pixels before which it comes. A tile's triangles lie in a piece of a frustum, and this in a ball. With M the axes of
// the frame, w = (x / z, y / z, 1) in the middle of the tile, to e from it, and depths d of the mean D,
//   |M d w' - M D w| <= |d - D| |M w| + d (e_x |M_x| + e_y |M_y|).
// Of the tiles that are left all triangles are looked at (tile_triangles.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "surfaces/depth_cells.h"
#include "surfaces/grid_ball.h"
#include "surfaces/tile_triangles.h"

namespace hl {

class DepthWalk {
 public:
  DepthWalk(const DepthCells& cells, const GridBall& ball)
      : cells_(cells),
        pixels_(cells.pixels()),
        ball_(ball),
        length_x_(cells.frame().axes.col(0).norm() / camera().fx),
        length_y_(cells.frame().axes.col(1).norm() / camera().fy),
        columns_(reached(0, camera().fx, camera().cx, pixels_.columns() - 1)),
        rows_(reached(1, camera().fy, camera().cy, pixels_.rows() - 1)) {}

  /// Calls visit(id) for each triangle that the ball may touch. Returns the number of tiles and cells visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    if (columns_.empty || rows_.empty) return 0;
    enterTop();
    while (count_ > 0) {
      const Tile tile = waiting_[--count_];
      ++looked_;
      if (misses(tile)) continue;
      if (tile.level == 0)
        enterCells(tile, visit);
      else
        add(tile.level - 1, part(columns_, tile.level - 1, tile.column), part(rows_, tile.level - 1, tile.row));
    }
    visitFound(visit);
    return looked_;
  }

 private:
  /// A triangle, and the fraction of the motion before which the ball is not at it.
  struct Found {
    double time;
    ElementId id;
  };
  struct Tile {
    std::uint32_t column, row;
    int level;
  };
  struct Range {
    std::uint32_t first, last;
    bool empty = false;
  };

  const DepthCamera& camera() const { return cells_.image()->camera; }
  const DepthTiles& tiles() const { return cells_.image()->tiles; }

  // The cells before which the ball comes, along an axis of the image: x / z is least, and greatest, at one of the ends
  // of z.
  Range reached(Eigen::Index axis, double focal, double centre, std::uint32_t cells) const {
    constexpr double kMargin = 1e-9;  // of the numbers that are added
    const double near = ball_.low().z(), far = ball_.high().z();
    if (!(far > 0)) return {0, 0, true};
    if (!(near > 0)) return {0, cells - 1};
    const double low = ball_.low()[axis], high = ball_.high()[axis];
    const double from = focal * (low / (low < 0 ? near : far)), to = focal * (high / (high > 0 ? near : far));
    const double margin = kMargin * (1 + std::abs(centre) + std::max(std::abs(from), std::abs(to)));
    const double first = centre + from - margin, last = centre + to + margin;
    if (!(first < cells && last >= 0)) return {0, 0, true};
    return {static_cast<std::uint32_t>(std::max(first, 0.0)), static_cast<std::uint32_t>(std::min(last, cells - 1.0))};
  }
  // Those of a range of cells, as tiles of a level, that are in the tile `of` of the next.
  static Range part(const Range& cells, int level, std::uint32_t of) {
    const std::uint64_t side = DepthTiles::side(level);
    const std::uint32_t first = of * DepthTiles::kTiles;
    return {std::max(first, static_cast<std::uint32_t>(cells.first / side)),
            std::min(first + DepthTiles::kTiles - 1, static_cast<std::uint32_t>(cells.last / side))};
  }

  // The highest levels, of which a small ball meets one tile or two, exclude nothing.
  void enterTop() {
    const std::uint64_t span = std::max(columns_.last - columns_.first, rows_.last - rows_.first);
    int level = 0;
    while (level + 1 < tiles().levels() && DepthTiles::side(level) < span) ++level;
    const auto all = [&](const Range& cells) {
      const std::uint64_t side = DepthTiles::side(level);
      return Range{static_cast<std::uint32_t>(cells.first / side), static_cast<std::uint32_t>(cells.last / side)};
    };
    add(level, all(columns_), all(rows_));
  }
  void add(int level, const Range& columns, const Range& rows) {
    for (std::uint32_t row = rows.first; row <= rows.last; ++row) {
      for (std::uint32_t column = columns.first; column <= columns.last; ++column)
        waiting_[count_++] = {column, row, level};
    }
  }

  bool misses(const Tile& tile) const {
    const DepthRange& range = tiles().range(tile.level, tile.column, tile.row);
    if (range.empty() || ball_.high().z() < range.low || ball_.low().z() > range.high) return true;
    const Mat3& axes = cells_.frame().axes;
    const double half = 0.5 * static_cast<double>(DepthTiles::side(tile.level)), mean = 0.5 * (range.low + range.high);
    const double column = 2 * half * tile.column + half, row = 2 * half * tile.row + half;
    const Vec3 way = axes * Vec3(camera().across(column), camera().down(row), 1);
    const double reach =
        0.5 * (range.high - range.low) * way.norm() + range.high * half * (length_x_ + length_y_) + ball_.radius();
    const Vec3 from = mean * way - axes * ball_.first(), motion = axes * (ball_.last() - ball_.first());
    const double square = motion.squaredNorm(), part = square > 0 ? std::clamp(from.dot(motion) / square, 0.0, 1.0) : 0;
    return (from - part * motion).squaredNorm() > (1 + kRounding) * reach * reach;
  }

  template <typename Visit>
  void enterCells(const Tile& tile, const Visit& visit) {
    constexpr std::uint32_t kCells = DepthTiles::kCells;
    static_assert(kCells == TileBall::kCells);
    const std::uint32_t column = tile.column * kCells, first = std::max(columns_.first, column);
    const std::uint32_t last = std::min(columns_.last, column + kCells - 1);
    const std::uint32_t top = std::max(rows_.first, tile.row * kCells);
    const std::uint32_t rows = std::min(rows_.last + 1, (tile.row + 1) * kCells) - top;
    TileTouches touches;
    touchedTriangles(ballOver(column, top, tiles().range(0, tile.column, tile.row).high), pixels_.row(top) + column,
                     pixels_.columns(), rows, touches);
    looked_ += rows * kCells / kCellsPerLook;
    const unsigned reached = ((2U << (last - first)) - 1) << (first - column);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (unsigned left = touches.bits[row] & (reached | reached << kCells); left != 0; left &= left - 1) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(left));
        keep({column + bit % kCells, top + row, bit / kCells}, touches.earliest[row][bit], visit);
      }
    }
  }

  // Those that the ball meets first are visited first: the others may then be out of its way.
  template <typename Visit>
  void keep(const HeightCell& cell, float earliest, const Visit& visit) {
    if (found_count_ == found_.size()) visitFound(visit);
    const double time = ball_.begin() + 0.5 * (earliest + 1.0) * (ball_.end() - ball_.begin());
    found_[found_count_++] = {time, idOf(cell, pixels_.columns())};
  }
  template <typename Visit>
  void visitFound(const Visit& visit) {
    const auto later = [](const Found& a, const Found& b) {
      return a.time > b.time || (a.time == b.time && a.id > b.id);
    };
    Found *const begin = found_.data(), *end = begin + found_count_;
    std::make_heap(begin, end, later);
    for (; begin != end && begin->time <= ball_.end(); --end) {
      if (cells_.exists(cellOf(begin->id, pixels_.columns()))) visit(begin->id);
      std::pop_heap(begin, end, later);
    }
    found_count_ = 0;
  }

  // As it is now, for the pixels of a tile from (column, row) on, none of them deeper than `deepest`.
  TileBall ballOver(std::uint32_t column, std::uint32_t row, double deepest) const {
    const Mat3& axes = cells_.frame().axes;
    const Vec3 middle = axes * (0.5 * (ball_.first() + ball_.last()));
    const Vec3 half = axes * (0.5 * (ball_.last() - ball_.first()));
    const double across = camera().across(column), down = camera().down(row);
    const double step_x = 1 / camera().fx, step_y = 1 / camera().fy;
    const Vec3 farthest(std::abs(across) + TileBall::kCells * step_x, std::abs(down) + TileBall::kCells * step_y, 1);
    const double size = middle.norm() + half.norm() + deepest * (axes.cwiseAbs() * farthest).norm();
    const double unit = 1 / ((1 + kRounding) * ball_.radius() + kRounding * size);
    TileBall ball;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      for (std::size_t n = 0; n < TileBall::kPixels; ++n) {
        const auto at = static_cast<double>(n);
        ball.column[k][n] = static_cast<float>(unit * axes(axis, 0) * (across + at * step_x));
        ball.row[k][n] = static_cast<float>(unit * (axes(axis, 1) * (down + at * step_y) + axes(axis, 2)));
      }
      ball.middle[k] = static_cast<float>(unit * middle[axis]);
      ball.half[k] = static_cast<float>(unit * half[axis]);
    }
    ball.join = static_cast<float>(camera().join);
    return ball;
  }

  static constexpr double kRounding = 2e-6;  // of places and directions in float, some units of 2^-24
  static constexpr std::uint32_t kCellsPerLook = 4;
  static constexpr std::size_t kMaxFound = 128;
  static constexpr std::size_t kTilesOfTile = std::size_t{DepthTiles::kTiles} * DepthTiles::kTiles;

  const DepthCells& cells_;
  const DepthPixels& pixels_;
  const GridBall& ball_;
  const double length_x_, length_y_;  // m: of a pixel, for a unit of depth
  const Range columns_, rows_;
  std::size_t looked_ = 0, count_ = 0;
  std::size_t found_count_ = 0;
  std::array<Found, kMaxFound> found_;
  std::array<Tile, (DepthTiles::kMaxLevels + 1) * kTilesOfTile> waiting_;
};

}  // namespace hl
