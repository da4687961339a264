// BrickWalk: through bricks of bricks of cells, down to the cells that a moving ball may touch.
//
// It is a search by branch and bound, in the coordinates of the grid. Every piece has an `order`, a lower bound of when
// the ball comes to it: of the time of impact in a sweep, of the distance in an overlap. A piece is left out whose
// order is beyond what is found already, or in which the surface cannot be: |f - plane| <= e says where that is.
//
// A brick is left out if the surface is not in it, or if the ball does not meet it (equal_boxes.h). Of the parts of a
// brick the ball comes to, the first is entered first. So what is hit first is found soon, and all that the ball would
// only come to afterwards is left out: of a fine grid that is nearly everything.
//
// Whose bricks they are is a parameter; `Bricks` has
//   origin(), step()        of the grid, in the coordinates of the ball: its first corner, and the side of a cell
//   levels(), side(l, a)    bricks of level l along an axis; the last level is one brick
//   cells(a)                cells along an axis
//   holds(l, place)         whether the surface may be in a brick near the ball
// and for the brick for which holds() was asked last
//   low(), high()           where it may be, in the coordinates of the ball
//   forEachPart(l, first, end, v)
//                           calls v(place) for its parts from `first` to before `end` in which it may be, at a glance
//   sift(l, parts)          leaves out parts where it is not, or not near the ball; may make the order of others later
//   visitCell(place, v)     calls v(id) for each triangle of a cell
//   cost()                  of all these questions, in looks at boxes
// and may have
//   findCells(first, end, parts)
//                           in place of forEachPart() and sift() for cells, which are then not compared as boxes
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/fixed_vector.h"
#include "surfaces/brick_pyramid.h"
#include "surfaces/equal_boxes.h"
#include "surfaces/grid_ball.h"

namespace hl {

/// A part of a brick, itself a brick or a cell; `order` as EqualBoxes has it.
struct BrickPart {
  double order;
  std::array<std::uint32_t, 3> at;
};
inline constexpr std::size_t kMaxBrickParts = 64;
static_assert(BrickPyramid::kCells == 4 && BrickPyramid::kBricks == 4);
using BrickParts = FixedVector<BrickPart, kMaxBrickParts>;

template <typename Bricks>
class BrickWalk {
 public:
  /// `scale`: shortestStep() of the ball's frame.
  BrickWalk(Bricks& bricks, const Vec3& scale, const GridBall& ball) : bricks_(bricks), scale_(scale), ball_(ball) {}

  /// Calls visit(id) for each triangle that the ball may touch, those that it comes to first about first. Returns the
  /// cost, in looks at boxes.
  template <typename Visit>
  std::size_t run(const Visit& visit) {
    BrickParts first;
    const int level = findFirst(first);
    enterAll(level, first, visit);
    return looked_ + bricks_.cost();
  }

 private:
  using Place = std::array<std::uint32_t, 3>;
  /// From the first to before the end, along one axis.
  struct Span {
    std::uint32_t first, end;
  };
  // Of the pieces from `begin` to before `end`, `size` wide, those between two places.
  Span spanOf(std::size_t axis, double low, double high, std::uint32_t begin, std::uint32_t end, double size) const {
    const double origin = bricks_.origin()[static_cast<Eigen::Index>(axis)];
    const auto within = [&](double value) {
      return static_cast<std::uint32_t>(std::clamp<double>(std::floor((value - origin) / size), begin, end));
    };
    return {within(low), within(high + size)};
  }

  // Of the bricks of a level, or of cells: level -1.
  double sideOf(int level) const {
    return bricks_.step() * (level < 0 ? 1 : static_cast<double>(BrickPyramid::cells(level)));
  }
  std::uint32_t countOf(int level, std::size_t axis) const {
    return level < 0 ? bricks_.cells(axis) : bricks_.side(level, axis);
  }

  // Adds a piece that the ball may meet. `boxes`: of the size of its level.
  void add(const EqualBoxes& boxes, const Place& at, double size, BrickParts& parts) {
    BrickPart part{0, at};
    ++looked_;
    if (boxes.meets(bricks_.origin() + size * Vec3(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5), part.order))
      parts.push(part);
  }

  // The bricks of a level that are so large that the ball meets few of them.
  int findFirst(BrickParts& parts) {
    const Vec3 size = ball_.high() - ball_.low();
    int level = 0;
    while (level + 1 < bricks_.levels() && sideOf(level) < kPerBall * size.maxCoeff()) ++level;
    Place first{}, end{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      const Span span = spanOf(axis, ball_.low()[a], ball_.high()[a], 0, countOf(level, axis), sideOf(level));
      first[axis] = span.first;
      end[axis] = span.end;
    }
    const EqualBoxes boxes(ball_, scale_, Vec3::Constant(sideOf(level) / 2));
    forEachPlace(first, end, [&](const Place& at) { add(boxes, at, sideOf(level), parts); });
    return level;
  }

  void findParts(int level, const Place& at, BrickParts& parts) {
    Place first{}, end{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      const std::uint32_t per_brick = level == 0 ? BrickPyramid::kCells : BrickPyramid::kBricks;
      const std::uint32_t begin = at[axis] * per_brick, past = std::min(begin + per_brick, countOf(level - 1, axis));
      const Span span = spanOf(axis, bricks_.low()[a], bricks_.high()[a], begin, past, sideOf(level - 1));
      if (span.first >= span.end) return;
      first[axis] = span.first;
      end[axis] = span.end;
    }
    if constexpr (requires { bricks_.findCells(first, end, parts); }) {
      if (level == 0) return bricks_.findCells(first, end, parts);
    }
    const double size = sideOf(level - 1);
    const EqualBoxes boxes(ball_, scale_, Vec3::Constant(size / 2));
    bricks_.forEachPart(level, first, end, [&](const Place& part) { add(boxes, part, size, parts); });
    bricks_.sift(level, parts);
  }

  // Visits pieces of a level in the order in which the ball comes to them.
  template <typename Visit>
  void enterAll(int level, BrickParts& parts, const Visit& visit) {
    std::sort(parts.begin(), parts.end(), [](const BrickPart& a, const BrickPart& b) { return a.order < b.order; });
    const bool moves = ball_.last() != ball_.first();
    for (const BrickPart& part : parts) {
      if (part.order > (moves ? ball_.end() : (1 + kRounding) * ball_.radius())) return;
      level < 0 ? bricks_.visitCell(part.at, visit) : enter(level, part.at, visit);
    }
  }

  template <typename Visit>
  void enter(int level, const Place& at, const Visit& visit) {
    if (!bricks_.holds(level, at)) return;
    BrickParts parts;
    findParts(level, at, parts);
    enterAll(level - 1, parts, visit);
  }

  static constexpr double kPerBall = 1;      // a first brick is at least so many times as wide as the moving ball
  static constexpr double kRounding = 1e-9;  // of a radius

  Bricks& bricks_;
  const Vec3& scale_;
  const GridBall& ball_;
  std::size_t looked_ = 0;
};

}  // namespace hl
