#include "surfaces/height_index.h"

#include <algorithm>
#include <cmath>

#include "surfaces/cell_search.h"
#include "surfaces/height_walk.h"

namespace hl {

double HeightIndex::extent() const {
  const Box box = field_.bounds();
  return std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
}

std::size_t HeightIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent()));
  return HeightWalk(field_, ball).run(visit);
}

std::size_t HeightIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                               FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent()));
  const auto walk = [this](const GridBall& part, const auto& found) { return HeightWalk(field_, part).run(found); };
  return sweepCells(ball, motion.norm(), soon, walk, visit);
}

std::size_t HeightIndex::nearest(const Vec3& centre, double farthest,
                                 FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const double cell = field_.frame().axes.col(0).norm() + field_.frame().axes.col(1).norm();
  const auto walk = [this](const GridBall& part, const auto& found) { return HeightWalk(field_, part).run(found); };
  const double size = field_.bounds().size().norm() + (centre - field_.bounds().centre()).norm();
  return nearestCell(ball, farthest, cell, std::max(size, extent()), walk, visit);
}

IndexStats HeightIndex::stats() const {
  const HeightPyramid& pyramid = field_.pyramid();
  IndexStats stats;
  stats.bytes = pyramid.bytes();
  stats.depth = pyramid.levels();
  stats.leaves = std::size_t{pyramid.columns(0)} * pyramid.rows(0);
  for (int level = 1; level < pyramid.levels(); ++level)
    stats.nodes += std::size_t{pyramid.columns(level)} * pyramid.rows(level);
  return stats;
}

}  // namespace hl
