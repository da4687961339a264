// The three queries of a SpatialIndex over a surface whose cells are found by a walk. The walk is the index's own:
//   walk(const GridBall& ball, visit)
// calls visit(id) for each primitive that the ball may touch on the part of its way, reads the ball again after each
// call, as visit() may make the part shorter or the radius smaller, and returns the number of volumes visited.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/function_ref.h"
#include "geometry/element_id.h"
#include "surfaces/grid_ball.h"

namespace hl {

/// A radius with a margin for the rounding of exact tests: a few units of 2^-53 times the largest coordinate. `extent`:
/// m, largest absolute coordinate of the surface.
inline double reachOf(double radius, const Vec3& from, const Vec3& motion, double extent) {
  constexpr double kRounding = 1e-14;
  return radius + kRounding * (from.cwiseAbs().maxCoeff() + motion.cwiseAbs().maxCoeff() + extent);
}

/// As SpatialIndex::sweep. Searches a first part of the way, and the next, eight times as long, only if nothing is hit:
/// goals are far away, and most ways end soon.
template <typename Walk>
std::size_t sweepCells(GridBall ball, double length, double soon, const Walk& walk,
                       FunctionRef<double(ElementId primitive, double limit)> visit) {
  constexpr double kMinPart = 1.0 / 8192, kLarger = 8;
  double soonest = 1;
  std::size_t looked = 0;
  double begin = 0;
  for (double part = soon < length ? std::max(kMinPart, soon / length) : 1;; part = std::min(1.0, kLarger * part)) {
    ball.setPart(begin, std::min(part, soonest));
    looked += walk(ball, [&](ElementId id) {
      soonest = std::min(soonest, visit(id, soonest));
      if (soonest < ball.end()) ball.setPart(std::min(begin, soonest), soonest);
    });
    if (soonest <= part || part >= 1) return looked;
    begin = part;
  }
}

/// As SpatialIndex::nearest: balls of growing radius, until one meets something. `cell`, `extent`: m, size of a cell
/// and of the surface with its distance from `ball`.
template <typename Walk>
std::size_t nearestCell(GridBall ball, double farthest, double cell, double extent, const Walk& walk,
                        FunctionRef<double(ElementId primitive, double limit)> visit) {
  constexpr double kLarger = 4;
  double limit = farthest;
  std::size_t looked = 0;
  for (double radius = cell;; radius *= kLarger) {
    const double tried = std::min({radius, limit, 2 * extent});
    ball.setRadius(tried * (1 + 1e-12) + 1e-14 * extent);
    looked += walk(ball, [&](ElementId id) {
      const double next = visit(id, limit);
      if (next < limit) limit = next;
      if (limit < tried) ball.setRadius(limit * (1 + 1e-12) + 1e-14 * extent);
    });
    if (limit <= radius || radius >= 2 * extent) return looked;
  }
}

}  // namespace hl
