// BrickWalk: from the pyramid's top to the cells that a moving ball may touch.
//
// A brick is left out if the surface's value is not in its range, or if the ball does not meet it (ball_boxes.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surfaces/ball_boxes.h"
#include "surfaces/grid_ball.h"
#include "surfaces/iso_cells.h"

namespace hl {

class BrickWalk {
 public:
  /// `scale`: shortestStep() of the cells' frame.
  BrickWalk(const IsoCells& cells, const Vec3& scale, const GridBall& ball)
      : cells_(cells), pyramid_(cells.volume()->pyramid), ball_(ball), boxes_(ball, scale) {}

  /// Calls visit(id) for each triangle that the ball may touch, those near its begin first. Returns the number of
  /// bricks and cells visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    enter(pyramid_.levels() - 1, {0, 0, 0}, visit);
    return looked_;
  }

 private:
  using Place = std::array<std::uint32_t, 3>;

  // Whether the ball may meet the box of `size` steps a side that begins at `first`.
  bool meets(const Vec3& first, double size) const {
    return boxes_.meets(first.array() + size / 2, Vec3::Constant(size / 2));
  }

  // The parts of the brick at `at` that the bounds of the ball meet, along one axis.
  struct Span {
    std::uint32_t first, end;
  };
  Span spanOf(std::size_t axis, std::uint32_t brick, std::uint32_t per_brick, std::uint32_t parts, double size) const {
    const auto a = static_cast<Eigen::Index>(axis);
    const std::uint32_t begin = brick * per_brick, end = std::min(begin + per_brick, parts);
    const auto within = [&](double value) {
      return static_cast<std::uint32_t>(std::clamp<double>(std::floor(value), begin, end));
    };
    return {within(ball_.low()[a] / size), within(ball_.high()[a] / size + 1)};
  }

  // Visits the parts, in the order in which the ball comes to them along each axis.
  template <typename Enter>
  void forEachPart(int level, const Place& at, const Enter& enter) {
    const double size = level == 0 ? 1 : static_cast<double>(BrickPyramid::cells(level - 1));
    std::array<Span, 3> span{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t parts = level == 0 ? cells_.volume()->grid.cells(axis) : pyramid_.side(level - 1, axis);
      span[axis] = spanOf(axis, at[axis], level == 0 ? BrickPyramid::kCells : BrickPyramid::kBricks, parts, size);
    }
    const Vec3 way = ball_.last() - ball_.first();
    const auto ordered = [&](std::size_t axis, std::uint32_t i) {
      return way[static_cast<Eigen::Index>(axis)] < 0 ? span[axis].end - 1 - (i - span[axis].first) : i;
    };
    for (std::uint32_t k = span[2].first; k < span[2].end; ++k) {
      for (std::uint32_t j = span[1].first; j < span[1].end; ++j) {
        for (std::uint32_t i = span[0].first; i < span[0].end; ++i) {
          const Place part{ordered(0, i), ordered(1, j), ordered(2, k)};
          ++looked_;
          if (meets(size * Vec3(part[0], part[1], part[2]), size)) enter(part);
        }
      }
    }
  }

  template <typename Visit>
  void enter(int level, const Place& at, const Visit& visit) {
    if (!pyramid_.range(level, at[0], at[1], at[2]).holds(cells_.iso().value)) return;
    if (level > 0) return forEachPart(level, at, [&](const Place& part) { enter(level - 1, part, visit); });
    forEachPart(0, at, [&](const Place& part) {
      const IsoCell cell = cells_.at(part);
      if (cell.triangles == nullptr) return;
      for (unsigned n = 0; n < cell.triangles->count; ++n) {
        if (cells_.exists(cell, n)) visit(cells_.idOf(cell, n));
      }
    });
  }

  const IsoCells& cells_;
  const BrickPyramid& pyramid_;
  const GridBall& ball_;
  const BallBoxes boxes_;
  std::size_t looked_ = 0;
};

}  // namespace hl
