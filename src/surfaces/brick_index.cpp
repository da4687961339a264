#include "surfaces/brick_index.h"

#include <algorithm>
#include <cmath>

#include "surfaces/brick_walk.h"
#include "surfaces/cell_search.h"

namespace hl {

namespace {

auto walkOver(const IsoSurface& surface) {
  return [&surface](const GridBall& ball, const auto& visit) { return BrickWalk(surface, ball).run(visit); };
}

}  // namespace

// m, greatest coordinate.
double BrickIndex::extent() const {
  const Box box = surface_.bounds();
  return box.empty() ? 0 : std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
}

std::size_t BrickIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent()));
  return BrickWalk(surface_, ball).run(visit);
}

std::size_t BrickIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                              FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent()));
  return sweepCells(ball, motion.norm(), soon, walkOver(surface_), visit);
}

std::size_t BrickIndex::nearest(const Vec3& centre, double farthest,
                                FunctionRef<double(ElementId, double)> visit) const {
  const Box bounds = surface_.bounds();
  if (bounds.empty()) return 0;
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const double cell = surface_.frame().axes.colwise().norm().maxCoeff();
  const double size = bounds.size().norm() + (centre - bounds.centre()).norm();
  return nearestCell(ball, farthest, cell, std::max(size, extent()), walkOver(surface_), visit);
}

IndexStats BrickIndex::stats() const {
  const BrickPyramid& pyramid = surface_.volume()->pyramid;
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = pyramid.levels();
  stats.leaves = std::size_t{pyramid.side(0, 0)} * pyramid.side(0, 1) * pyramid.side(0, 2);
  stats.nodes = pyramid.bricks() - stats.leaves;
  return stats;
}

}  // namespace hl
