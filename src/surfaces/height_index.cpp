#include "surfaces/height_index.h"

#include <algorithm>
#include <cmath>

#include "surfaces/cell_search.h"
#include "surfaces/height_walk.h"

namespace hl {

HeightIndex::HeightIndex(const HeightGrid& grid, const HeightPyramid& pyramid, const GridFrame& frame,
                         const Box& bounds)
    : grid_(grid),
      pyramid_(pyramid),
      metric_(frame),
      bounds_(bounds),
      extent_(bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).maxCoeff()),
      cell_(frame.axes.col(0).norm() + frame.axes.col(1).norm()) {}

std::size_t HeightIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent_));
  return HeightWalk(grid_, pyramid_, ball).run(visit);
}

std::size_t HeightIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                               FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent_));
  const auto walk = [this](const GridBall& part, const auto& found) {
    return HeightWalk(grid_, pyramid_, part).run(found);
  };
  return sweepCells(ball, motion.norm(), soon, walk, visit);
}

std::size_t HeightIndex::nearest(const Vec3& centre, double farthest,
                                 FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const auto walk = [this](const GridBall& part, const auto& found) {
    return HeightWalk(grid_, pyramid_, part).run(found);
  };
  const double size = bounds_.size().norm() + (centre - bounds_.centre()).norm();
  return nearestCell(ball, farthest, cell_, std::max(size, extent_), walk, visit);
}

IndexStats HeightIndex::stats() const {
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = pyramid_.levels();
  stats.leaves = std::size_t{pyramid_.columns(0)} * pyramid_.rows(0);
  for (int level = 1; level < pyramid_.levels(); ++level)
    stats.nodes += std::size_t{pyramid_.columns(level)} * pyramid_.rows(level);
  return stats;
}

}  // namespace hl
