// HeightWalk: from the pyramid's top to the cells that a moving ball may touch. HeightIndex has the derivation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surfaces/grid_ball.h"
#include "surfaces/height_cell.h"
#include "surfaces/height_grid.h"
#include "surfaces/height_pyramid.h"

namespace hl {

/// The two paraboloids around a ball, one below and one above, for surfaces of a slope. Grid coordinates.
class BallBowls {
 public:
  BallBowls(const GridBall& ball, double slope_column, double slope_row) : ball_(ball) {
    const GridMetric& metric = ball.metric();
    const double sum[2] = {slope_column + metric.tilt.x(), slope_row + metric.tilt.y()};
    const double k =
        ball.lift() / std::sqrt(1 + sum[0] * sum[0] / metric.curve.x() + sum[1] * sum[1] / metric.curve.y());
    depth_ = 0.5 * (k + ball.lift() * ball.lift() / k);
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      vertex_[axis] = k / metric.curve[axis];
      square_[axis] = 0.5 / vertex_[axis];
    }
  }

  double depth() const { return depth_; }
  /// Least value of square d^2 - slope d over the steps d from the moving centre to the places first..last.
  double least(Eigen::Index axis, double slope, double first, double last) const {
    const double low = first - std::max(ball_.first()[axis], ball_.last()[axis]);
    const double high = last - std::min(ball_.first()[axis], ball_.last()[axis]);
    const double d = std::clamp(slope * vertex_[axis], low, high);
    return (square_[axis] * d - slope) * d;
  }

 private:
  const GridBall& ball_;
  double depth_;
  Vec2 vertex_, square_;
};

/// A moving ball seen from a plane through a place of the grid.
struct BallOverPlane {
  BallOverPlane(const GridBall& ball, const HeightSlab& slab, double column, double row) {
    const auto over = [&](const Vec3& centre) {
      const double across = slab.slope_column * (centre.x() - column), down = slab.slope_row * (centre.y() - row);
      size = std::max(size, std::abs(centre.z()) + std::abs(across) + std::abs(down));
      return centre.z() - across - down;
    };
    const double first = over(ball.first()), last = over(ball.last());
    low = std::min(first, last);
    high = std::max(first, last);
    size = kRounding * (size + std::abs(slab.low) + std::abs(slab.high));
  }

  static constexpr double kRounding = 1e-12;
  double low, high;  ///< of the centre
  double size = 0;   ///< bound of what rounding does
};

class HeightWalk {
 public:
  HeightWalk(const HeightGrid& grid, const HeightPyramid& pyramid, const GridBall& ball)
      : grid_(grid), pyramid_(pyramid), tilt_(ball.metric().tilt), ball_(ball) {}

  /// Calls visit(id) for each triangle that the ball may touch. Returns the number of slabs and cells visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    const int top = pyramid_.levels() - 1;
    if (pyramid_.slab(top, 0, 0).empty()) return 1;
    waiting_[count_++] = {0, 0, top};
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
    if (low > last || high < first) return {0, 0, true};
    return {static_cast<std::uint32_t>(std::max<double>(low, first)),
            static_cast<std::uint32_t>(std::min<double>(high, last)), false};
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
    const BallBowls bowls(ball_, slab.slope_column, slab.slope_row);
    // The last to be added is the first to be entered: the one where the way begins.
    const bool ascends = ball_.first().x() > ball_.last().x(), rows_ascend = ball_.first().y() > ball_.last().y();
    for (std::uint32_t n = j.first; n <= j.last; ++n) {
      const std::uint32_t at_row = rows_ascend ? n : j.last - (n - j.first);
      for (std::uint32_t m = i.first; m <= i.last; ++m) {
        const std::uint32_t at_column = ascends ? m : i.last - (m - i.first);
        ++looked_;
        const HeightSlab& child = pyramid_.slab(level, at_column, at_row);
        if (!child.empty() && meets(bowls, child, at_column * side, at_row * side, side))
          waiting_[count_++] = {at_column, at_row, level};
      }
    }
  }

  // A block at the rim may be narrower than `side`: then more is proposed than need be.
  bool meets(const BallBowls& bowls, const HeightSlab& slab, double column, double row, double side) const {
    const BallOverPlane ball(ball_, slab, column, row);
    const double across = slab.slope_column + tilt_.x(), down = slab.slope_row + tilt_.y();
    if (ball.low + ball.high > double{slab.low} + slab.high) {
      const double bowl = bowls.least(0, across, column, column + side) + bowls.least(1, down, row, row + side);
      return !(slab.high + ball.size < ball.low - (1 + kMargin) * bowls.depth() + bowl);
    }
    const double bowl = bowls.least(0, -across, column, column + side) + bowls.least(1, -down, row, row + side);
    return !(slab.low - ball.size > ball.high + (1 + kMargin) * bowls.depth() - bowl);
  }

  template <typename Visit>
  void enterCells(const Block& block, const Visit& visit) {
    constexpr std::uint32_t kCells = HeightPyramid::kCells;
    const std::uint32_t column = block.column * kCells, row = block.row * kCells;
    const Range i = reached(0, 1, column, std::min(column + kCells, grid_.columns() - 1) - 1);
    const Range j = reached(1, 1, row, std::min(row + kCells, grid_.rows() - 1) - 1);
    if (i.empty || j.empty) return;
    const HeightSlab& slab = pyramid_.slab(0, block.column, block.row);
    const double across = slab.slope_column, down = slab.slope_row;
    const BallBowls bowls(ball_, across, down);
    const BallOverPlane ball(ball_, slab, column, row);
    const double depth = (1 + kMargin) * bowls.depth() + ball.size;
    // Bounds on the height over the plane, by column, of what lies wholly below the ball and wholly above it.
    double below[kCells], above[kCells];
    for (std::uint32_t m = i.first; m <= i.last; ++m) {
      below[m - column] = ball.low - depth + bowls.least(0, across + tilt_.x(), m, m + 1.0);
      above[m - column] = ball.high + depth - bowls.least(0, -across - tilt_.x(), m, m + 1.0);
    }
    for (std::uint32_t n = j.first; n <= j.last; ++n) {
      const double row_below = bowls.least(1, down + tilt_.y(), n, n + 1.0);
      const double row_above = -bowls.least(1, -down - tilt_.y(), n, n + 1.0);
      const auto rest = [&](std::uint32_t m, std::uint32_t at_row) {
        return grid_.at(m, at_row) - across * (m - column) - down * (at_row - row);
      };
      double a = rest(i.first, n), c = rest(i.first, n + 1);
      for (std::uint32_t m = i.first; m <= i.last; ++m) {
        ++looked_;
        const double b = rest(m + 1, n), d = rest(m + 1, n + 1);
        if (!std::isnan(a + b + c + d)) {
          const double low = above[m - column] + row_above, high = below[m - column] + row_below;
          const auto touched = [&](double third) {
            return !(std::max({a, d, third}) < high || std::min({a, d, third}) > low);
          };
          if (touched(b)) visit(idOf({m, n, 0}, grid_.columns()));
          if (touched(c)) visit(idOf({m, n, 1}, grid_.columns()));
        }
        a = b;
        c = d;
      }
    }
  }

  static constexpr double kMargin = 1e-12;
  static constexpr std::size_t kBlocksOfBlock = std::size_t{HeightPyramid::kBlocks} * HeightPyramid::kBlocks;

  const HeightGrid& grid_;
  const HeightPyramid& pyramid_;
  const Vec2 tilt_;
  const GridBall& ball_;
  std::size_t looked_ = 0, count_ = 0;
  std::array<Block, HeightPyramid::kMaxLevels * kBlocksOfBlock> waiting_;
};

}  // namespace hl
