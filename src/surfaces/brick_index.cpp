#include "surfaces/brick_index.h"

#include <algorithm>
#include <cmath>

#include "surfaces/brick_walk.h"
#include "surfaces/cell_search.h"

namespace hl {

namespace {

auto walkOver(const IsoCells& cells, const Vec3& scale) {
  return [&cells, &scale](const GridBall& ball, const auto& visit) { return BrickWalk(cells, scale, ball).run(visit); };
}

}  // namespace

BrickIndex::BrickIndex(const IsoCells& cells, const Box& bounds)
    : cells_(cells),
      bounds_(bounds),
      metric_(cells.frame()),
      scale_(shortestStep(cells.frame())),
      extent_(bounds.empty() ? 0 : bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).maxCoeff()),
      cell_(cells.frame().axes.colwise().norm().maxCoeff()) {}

std::size_t BrickIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent_));
  return BrickWalk(cells_, scale_, ball).run(visit);
}

std::size_t BrickIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                              FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent_));
  return sweepCells(ball, motion.norm(), soon, walkOver(cells_, scale_), visit);
}

std::size_t BrickIndex::nearest(const Vec3& centre, double farthest,
                                FunctionRef<double(ElementId, double)> visit) const {
  if (bounds_.empty()) return 0;
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const double size = bounds_.size().norm() + (centre - bounds_.centre()).norm();
  return nearestCell(ball, farthest, cell_, std::max(size, extent_), walkOver(cells_, scale_), visit);
}

IndexStats BrickIndex::stats() const {
  const BrickPyramid& pyramid = cells_.volume()->pyramid;
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = pyramid.levels();
  stats.leaves = std::size_t{pyramid.side(0, 0)} * pyramid.side(0, 1) * pyramid.side(0, 2);
  stats.nodes = pyramid.bricks() - stats.leaves;
  return stats;
}

}  // namespace hl
