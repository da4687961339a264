#include "surfaces/depth_index.h"

#include <algorithm>

#include "surfaces/cell_search.h"
#include "surfaces/depth_walk.h"

namespace hl {

namespace {

// Of the nearest triangles.
double cellOf_m(const DepthFrame& frame) {
  const DepthCamera& camera = frame.image()->camera;
  return frame.image()->tiles.all().low *
         (frame.frame().axes.col(0).norm() / camera.fx + frame.frame().axes.col(1).norm() / camera.fy);
}

}  // namespace

DepthIndex::DepthIndex(const DepthFrame& frame)
    : frame_(frame),
      metric_(frame.frame()),
      extent_(frame.bounds().min.cwiseAbs().cwiseMax(frame.bounds().max.cwiseAbs()).maxCoeff()),
      cell_(cellOf_m(frame)) {}

std::size_t DepthIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent_));
  return DepthWalk(frame_, ball).run(visit);
}

std::size_t DepthIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                              FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent_));
  const auto walk = [this](const GridBall& part, const auto& found) { return DepthWalk(frame_, part).run(found); };
  return sweepCells(ball, motion.norm(), soon, walk, visit);
}

std::size_t DepthIndex::nearest(const Vec3& centre, double farthest,
                                FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const auto walk = [this](const GridBall& part, const auto& found) { return DepthWalk(frame_, part).run(found); };
  const Box& bounds = frame_.bounds();
  const double size = bounds.size().norm() + (centre - bounds.centre()).norm();
  return nearestCell(ball, farthest, cell_, std::max(size, extent_), walk, visit);
}

IndexStats DepthIndex::stats() const {
  const DepthTiles& tiles = frame_.image()->tiles;
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = tiles.levels();
  stats.leaves = std::size_t{tiles.columns(0)} * tiles.rows(0);
  for (int level = 1; level < tiles.levels(); ++level)
    stats.nodes += std::size_t{tiles.columns(level)} * tiles.rows(level);
  return stats;
}

}  // namespace hl
