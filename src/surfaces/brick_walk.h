// BrickWalk: from the pyramid's top to the cells that a moving ball may touch.
//
// A brick is left out if the surface's value is not in its range; if it does not meet the bounds of the ball, whose
// centre moves along a segment (a slab test); or if its middle is farther from the segment than the radius and half of
// its diagonal. That distance is measured along the axes of the grid, each with a scale that makes nothing longer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "surfaces/grid_ball.h"
#include "surfaces/iso_cells.h"

namespace hl {

// m per step along each axis, so that no step is longer than it is. Q = axes^T axes is not below its diagonal times
// 1 - s, s the largest sum of a row of the others, once the diagonal is 1 (Gershgorin).
inline Vec3 shortestStep(const GridFrame& frame) {
  const Mat3 q = frame.axes.transpose() * frame.axes;
  const Vec3 length = q.diagonal().cwiseSqrt();
  double skew = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    double row = 0;
    for (Eigen::Index j = 0; j < 3; ++j) row += i == j ? 0 : std::abs(q(i, j)) / (length[i] * length[j]);
    skew = std::max(skew, row);
  }
  return std::sqrt(std::max(0.0, 1 - skew)) * length;
}

class BrickWalk {
 public:
  /// `scale`: shortestStep() of the cells' frame.
  BrickWalk(const IsoCells& cells, const Vec3& scale, const GridBall& ball)
      : cells_(cells), pyramid_(cells.volume()->pyramid), scale_(scale), ball_(ball) {}

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
    const Vec3 middle = first.array() + size / 2, way = ball_.last() - ball_.first();
    const Vec3 half = ((ball_.high() - ball_.low() - way.cwiseAbs()).array() + size) / 2;
    double begin = 0, end = 1;  // of the way, while the middle is within `half` of the centre
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double from = middle[axis] - ball_.first()[axis];
      if (way[axis] == 0) {
        if (std::abs(from) > half[axis]) return false;
        continue;
      }
      const double one = (from - half[axis]) / way[axis], other = (from + half[axis]) / way[axis];
      begin = std::max(begin, std::min(one, other) - kRounding);
      end = std::min(end, std::max(one, other) + kRounding);
    }
    if (begin > end) return false;
    const Vec3 from = scale_.cwiseProduct(middle - ball_.first()), along = scale_.cwiseProduct(way);
    const double square = along.squaredNorm();
    const double part = square > 0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0;
    const double reach = (1 + kRounding) * (ball_.radius() + size / 2 * scale_.norm());
    return (from - part * along).squaredNorm() <= reach * reach;
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

  static constexpr double kRounding = 1e-9;  // of sizes, and of a way

  const IsoCells& cells_;
  const BrickPyramid& pyramid_;
  const Vec3& scale_;
  const GridBall& ball_;
  std::size_t looked_ = 0;
};

}  // namespace hl
