// DepthWalk: from the tiles of a whole depth image to the cells that a moving ball may touch.
//
// A tile's triangles lie in a piece of a frustum, between four planes through the camera and two of equal depth. A ball
// on a straight way is clear of it if it is on the outer side of one of the six all the time. In grid coordinates q =
// (x / z depth, y / z depth, depth) of the camera the planes are a . q = c, and a ball of radius r reaches r |M^-T a|
// beyond its centre, M the axes of the frame.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surfaces/depth_cells.h"
#include "surfaces/grid_ball.h"

namespace hl {

class DepthWalk {
 public:
  DepthWalk(const DepthCells& cells, const GridBall& ball)
      : cells_(cells), ball_(ball), size_(ball.metric().inverse * ball.metric().inverse.transpose()) {}

  /// Calls visit(id) for each triangle that the ball may touch. Returns the number of tiles and cells visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    const DepthTiles& tiles = cells_.image()->tiles;
    waiting_[count_++] = {0, 0, tiles.levels() - 1};
    while (count_ > 0) {
      const Tile tile = waiting_[--count_];
      ++looked_;
      const auto side = static_cast<double>(DepthTiles::side(tile.level));
      const DepthRange& range = tiles.range(tile.level, tile.column, tile.row);
      if (range.empty() || misses({side * tile.column, side * tile.row, side, range.low, range.high})) continue;
      tile.level == 0 ? enterCells(tile, visit) : enterTile(tile);
    }
    return looked_;
  }

 private:
  struct Tile {
    std::uint32_t column, row;
    int level;
  };
  /// A square of pixels, and depths.
  struct Piece {
    double column, row, side, low, high;
  };

  // Whether all of the way is farther than the ball's reach on the negative side of sign (a . q - c).
  bool outside(const Vec3& a, double c, double sign) const {
    const double nearest = std::max(sign * (a.dot(ball_.first()) - c), sign * (a.dot(ball_.last()) - c));
    return nearest < 0 && nearest * nearest > ball_.radius() * ball_.radius() * a.dot(size_ * a);
  }
  bool misses(const Piece& piece) const {
    const DepthCamera& camera = cells_.image()->camera;
    const auto across = [&](double column) { return Vec3(1, 0, -camera.across(column)); };
    const auto down = [&](double row) { return Vec3(0, 1, -camera.down(row)); };
    return outside(Vec3::UnitZ(), piece.low, 1) || outside(Vec3::UnitZ(), piece.high, -1) ||
           outside(across(piece.column), 0, 1) || outside(across(piece.column + piece.side), 0, -1) ||
           outside(down(piece.row), 0, 1) || outside(down(piece.row + piece.side), 0, -1);
  }

  void enterTile(const Tile& tile) {
    constexpr std::uint32_t kTiles = DepthTiles::kTiles;
    const DepthTiles& tiles = cells_.image()->tiles;
    const int level = tile.level - 1;
    const std::uint32_t end = std::min((tile.column + 1) * kTiles, tiles.columns(level));
    const std::uint32_t bottom = std::min((tile.row + 1) * kTiles, tiles.rows(level));
    for (std::uint32_t row = tile.row * kTiles; row < bottom; ++row) {
      for (std::uint32_t column = tile.column * kTiles; column < end; ++column)
        waiting_[count_++] = {column, row, level};
    }
  }

  template <typename Visit>
  void enterCells(const Tile& tile, const Visit& visit) {
    constexpr std::uint32_t kCells = DepthTiles::kCells;
    const DepthPixels& grid = cells_.pixels();
    const std::uint32_t end = std::min((tile.column + 1) * kCells, grid.columns() - 1);
    const std::uint32_t bottom = std::min((tile.row + 1) * kCells, grid.rows() - 1);
    for (std::uint32_t j = tile.row * kCells; j < bottom; ++j) {
      for (std::uint32_t i = tile.column * kCells; i < end; ++i) {
        ++looked_;
        visitCell(i, j, grid, visit);
      }
    }
  }

  template <typename Visit>
  void visitCell(std::uint32_t i, std::uint32_t j, const DepthPixels& grid, const Visit& visit) const {
    const double a = grid.at(i, j), b = grid.at(i + 1, j), c = grid.at(i, j + 1), d = grid.at(i + 1, j + 1);
    const std::array<std::array<double, 3>, 2> half{{{a, d, b}, {a, c, d}}};
    for (const unsigned n : {0U, 1U}) {
      const auto [low, high] = std::minmax({half[n][0], half[n][1], half[n][2]});
      if (!(low > 0) || misses({static_cast<double>(i), static_cast<double>(j), 1, low, high})) continue;
      if (cells_.exists({i, j, n})) visit(idOf({i, j, n}, grid.columns()));
    }
  }

  static constexpr std::size_t kTilesOfTile = std::size_t{DepthTiles::kTiles} * DepthTiles::kTiles;

  const DepthCells& cells_;
  const GridBall& ball_;
  const Mat3 size_;  // |M^-T a|^2 = a . size_ a
  std::size_t looked_ = 0, count_ = 0;
  std::array<Tile, (DepthTiles::kMaxLevels + 1) * kTilesOfTile> waiting_;
};

}  // namespace hl
