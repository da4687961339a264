// HeightWalk: from the pyramid's top to the cells that a moving ball may touch. HeightIndex has the derivation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surfaces/ball_over_plane.h"
#include "surfaces/grid_ball.h"
#include "surfaces/height_cell.h"
#include "surfaces/height_grid.h"
#include "surfaces/height_pyramid.h"

namespace hl {

class HeightWalk {
 public:
  HeightWalk(const HeightGrid& grid, const HeightPyramid& pyramid, const GridBall& ball)
      : grid_(grid), pyramid_(pyramid), ball_(ball) {}

  /// Calls visit(id) for each triangle that the ball may touch. Returns the number of slabs and cells visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    enterTop();
    while (count_ > 0) {
      const Block block = waiting_[--count_];
      block.level == 0 ? enterCells(block, visit) : enterBlocks(block);
    }
    return looked_;
  }

 private:
  struct Block {
    std::uint32_t column, row;
    int level;
  };
  struct Range {
    std::uint32_t first, last;
    bool empty;
  };

  // Those of the parts first..last, each `side` cells long, that the ball is above or below.
  Range reached(Eigen::Index axis, double side, std::uint32_t first, std::uint32_t last) const {
    const double low = std::floor(ball_.low()[axis] / side - kMargin), high = ball_.high()[axis] / side + kMargin;
    if (!(low <= last && high >= first)) return {0, 0, true};
    return {static_cast<std::uint32_t>(std::max<double>(low, first)),
            static_cast<std::uint32_t>(std::min<double>(high, last)), false};
  }

  // The highest levels, of which a small ball meets one block or two, exclude nothing.
  void enterTop() {
    const double span = (ball_.high() - ball_.low()).head<2>().maxCoeff();
    int level = 0;
    while (level + 1 < pyramid_.levels() && !(static_cast<double>(HeightPyramid::side(level)) >= span)) ++level;
    const auto side = static_cast<double>(HeightPyramid::side(level));
    const Range i = reached(0, side, 0, pyramid_.columns(level) - 1), j = reached(1, side, 0, pyramid_.rows(level) - 1);
    if (i.empty || j.empty) return;
    const HeightSlab& slab = pyramid_.slab(level, i.first, j.first);
    add(i, j, level, BallBowls(ball_, slab.slope_column, slab.slope_row));
  }

  void enterBlocks(const Block& block) {
    constexpr std::uint32_t kBlocks = HeightPyramid::kBlocks;
    const int level = block.level - 1;
    const auto side = static_cast<double>(HeightPyramid::side(level));
    const std::uint32_t column = block.column * kBlocks, row = block.row * kBlocks;
    const Range i = reached(0, side, column, std::min(column + kBlocks, pyramid_.columns(level)) - 1);
    const Range j = reached(1, side, row, std::min(row + kBlocks, pyramid_.rows(level)) - 1);
    if (i.empty || j.empty) return;
    const HeightSlab& slab = pyramid_.slab(block.level, block.column, block.row);
    add(i, j, level, BallBowls(ball_, slab.slope_column, slab.slope_row));
  }

  // Those of the blocks that the ball may touch; the last to be added, where the way begins, is the first to be
  // entered.
  void add(const Range& i, const Range& j, int level, const BallBowls& bowls) {
    const bool to_west = ball_.first().x() > ball_.last().x(), to_north = ball_.first().y() > ball_.last().y();
    for (std::uint32_t n = j.first; n <= j.last; ++n) {
      const std::uint32_t row = to_north ? n : j.last - (n - j.first);
      for (std::uint32_t m = i.first; m <= i.last; ++m) {
        const std::uint32_t column = to_west ? m : i.last - (m - i.first);
        ++looked_;
        if (meets(bowls, {column, row, level})) waiting_[count_++] = {column, row, level};
      }
    }
  }

  // A block at the rim may be narrower than its side: then more is proposed than need be.
  bool meets(const BallBowls& bowls, const Block& block) const {
    const HeightSlab& slab = pyramid_.slab(block.level, block.column, block.row);
    if (slab.empty()) return false;
    const auto side = static_cast<double>(HeightPyramid::side(block.level));
    const double column = side * block.column, row = side * block.row;
    const BallOverPlane over(ball_, bowls, {column, row, slab.slope_column, slab.slope_row});
    return !over.clears(slab.low, slab.high, {column, column + side}, {row, row + side});
  }

  template <typename Visit>
  void enterCells(const Block& block, const Visit& visit) {
    constexpr std::uint32_t kCells = HeightPyramid::kCells;
    const std::uint32_t column = block.column * kCells, row = block.row * kCells;
    const Range i = reached(0, 1, column, std::min(column + kCells, grid_.columns() - 1) - 1);
    const Range j = reached(1, 1, row, std::min(row + kCells, grid_.rows() - 1) - 1);
    if (i.empty || j.empty) return;
    const HeightSlab& slab = pyramid_.slab(0, block.column, block.row);
    const GridPlane plane{static_cast<double>(column), static_cast<double>(row), slab.slope_column, slab.slope_row};
    const BallBowls bowls(ball_, slab.slope_column, slab.slope_row);
    const BallOverPlane over(ball_, bowls, plane);
    const double up = over.isAbove(0.5 * slab.low + 0.5 * slab.high) ? 1 : -1;
    std::array<double, kCells> clear;  // what is lower than that over the plane, in a row of no slope, is not touched
    for (std::uint32_t m = i.first; m <= i.last; ++m)
      clear[m - i.first] = over.clear(up) + over.least(up, 0, m, m + 1.0);
    for (std::uint32_t n = j.first; n <= j.last; ++n) {
      const double clear_row = over.least(up, 1, n, n + 1.0);
      const auto rest = [&](std::uint32_t m, std::uint32_t at) { return over.rest(m, at, grid_.at(m, at)); };
      double a = rest(i.first, n), c = rest(i.first, n + 1);
      for (std::uint32_t m = i.first; m <= i.last; ++m) {
        ++looked_;
        const double b = rest(m + 1, n), d = rest(m + 1, n + 1);
        if (!(up * a < clear[m - i.first] + clear_row && up * b < clear[m - i.first] + clear_row &&
              up * c < clear[m - i.first] + clear_row && up * d < clear[m - i.first] + clear_row))
          visitCell(m, n, bowls, visit);
        a = b;
        c = d;
      }
    }
  }

  // By the planes of both triangles; their slopes are about those of the block.
  template <typename Visit>
  void visitCell(std::uint32_t m, std::uint32_t n, const BallBowls& bowls, const Visit& visit) const {
    const double a = grid_.at(m, n), b = grid_.at(m + 1, n), c = grid_.at(m, n + 1), d = grid_.at(m + 1, n + 1);
    if (std::isnan(a + b + c + d)) return;
    const double column = m, row = n;
    const auto touched = [&](double across, double down) {
      const BallOverPlane over(ball_, bowls, {column, row, across, down});
      return !over.clears(a, a, {column, column + 1}, {row, row + 1});
    };
    if (touched(b - a, d - b)) visit(idOf({m, n, 0}, grid_.columns()));
    if (touched(d - c, c - a)) visit(idOf({m, n, 1}, grid_.columns()));
  }

  static constexpr double kMargin = 1e-12;
  static constexpr std::size_t kBlocksOfBlock = std::size_t{HeightPyramid::kBlocks} * HeightPyramid::kBlocks;

  const HeightGrid& grid_;
  const HeightPyramid& pyramid_;
  const GridBall& ball_;
  std::size_t looked_ = 0, count_ = 0;
  std::array<Block, (HeightPyramid::kMaxLevels + 1) * kBlocksOfBlock> waiting_;
};

}  // namespace hl
