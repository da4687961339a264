#include "surfaces/brick_index.h"

#include <algorithm>
#include <cmath>

#include "surfaces/brick_walk.h"
#include "surfaces/cell_search.h"

namespace hl {

namespace {

auto walkOver(const IsoCells& cells) {
  return [&cells](const GridBall& ball, const auto& visit) { return BrickWalk(cells, ball).run(visit); };
}

}  // namespace

// m, greatest coordinate.
double BrickIndex::extent() const {
  return bounds_.empty() ? 0 : std::max(bounds_.min.cwiseAbs().maxCoeff(), bounds_.max.cwiseAbs().maxCoeff());
}

std::size_t BrickIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent()));
  return BrickWalk(cells_, ball).run(visit);
}

std::size_t BrickIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                              FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent()));
  return sweepCells(ball, motion.norm(), soon, walkOver(cells_), visit);
}

std::size_t BrickIndex::nearest(const Vec3& centre, double farthest,
                                FunctionRef<double(ElementId, double)> visit) const {
  if (bounds_.empty()) return 0;
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const double cell = cells_.frame().axes.colwise().norm().maxCoeff();
  const double size = bounds_.size().norm() + (centre - bounds_.centre()).norm();
  return nearestCell(ball, farthest, cell, std::max(size, extent()), walkOver(cells_), visit);
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
