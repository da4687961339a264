// BrickWalk: through bricks of bricks of cells, down to the cells that a moving ball may touch.
//
// A brick is left out if the surface is not in it, or if the ball does not meet it (ball_boxes.h).
//
// Whose bricks they are is a parameter; `Bricks` has
//   origin(), step()        of the grid, in the coordinates of the ball: its first corner, and the side of a cell
//   levels(), side(l, a)    bricks of level l along an axis; the last level is one brick
//   cells(a)                cells along an axis
//   holds(l, place)         whether the surface may be in a brick near the ball
//   low(), high()           where in the brick for which holds() was asked last, in the coordinates of the ball
//   visitCell(place, v)     calls v(id) for each triangle of a cell of the brick for which holds() was asked last
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surfaces/ball_boxes.h"
#include "surfaces/brick_pyramid.h"
#include "surfaces/grid_ball.h"

namespace hl {

template <typename Bricks>
class BrickWalk {
 public:
  /// `scale`: shortestStep() of the ball's frame.
  BrickWalk(Bricks& bricks, const Vec3& scale, const GridBall& ball)
      : bricks_(bricks), ball_(ball), boxes_(ball, scale) {}

  /// Calls visit(id) for each triangle that the ball may touch, those near its begin first. Returns the number of
  /// bricks and cells visited.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    enter(bricks_.levels() - 1, {0, 0, 0}, visit);
    return looked_;
  }

 private:
  using Place = std::array<std::uint32_t, 3>;

  // Whether the ball may meet the box of `size` a side that begins at `first`.
  bool meets(const Vec3& first, double size) const {
    return boxes_.meets(first.array() + size / 2, Vec3::Constant(size / 2));
  }

  // The parts of a brick where the surface may be near the ball, along one axis.
  struct Span {
    std::uint32_t first, end;
  };
  Span spanOf(std::size_t axis, std::uint32_t brick, std::uint32_t per_brick, std::uint32_t parts, double size) const {
    const auto a = static_cast<Eigen::Index>(axis);
    const double origin = bricks_.origin()[a];
    const std::uint32_t begin = brick * per_brick, end = std::min(begin + per_brick, parts);
    const auto within = [&](double value) {
      return static_cast<std::uint32_t>(std::clamp<double>(std::floor(value), begin, end));
    };
    return {within((bricks_.low()[a] - origin) / size), within((bricks_.high()[a] - origin) / size + 1)};
  }

  // Visits the parts, in the order in which the ball comes to them along each axis.
  template <typename Enter>
  void forEachPart(int level, const Place& at, const Enter& enter) {
    const double size = bricks_.step() * (level == 0 ? 1 : static_cast<double>(BrickPyramid::cells(level - 1)));
    std::array<Span, 3> span{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t parts = level == 0 ? bricks_.cells(axis) : bricks_.side(level - 1, axis);
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
          if (meets(bricks_.origin() + size * Vec3(part[0], part[1], part[2]), size)) enter(part);
        }
      }
    }
  }

  template <typename Visit>
  void enter(int level, const Place& at, const Visit& visit) {
    if (!bricks_.holds(level, at)) return;
    forEachPart(level, at,
                [&](const Place& part) { level > 0 ? enter(level - 1, part, visit) : bricks_.visitCell(part, visit); });
  }

  Bricks& bricks_;
  const GridBall& ball_;
  const BallBoxes boxes_;
  std::size_t looked_ = 0;
};

}  // namespace hl
