#include "surfaces/cloud_index.h"

#include <algorithm>

#include "surfaces/cell_search.h"
#include "surfaces/cloud_walk.h"

namespace hl {

namespace {

auto walkIn(const PlacedCloud& cloud, const Vec3& scale) {
  return [&cloud, &scale](const GridBall& ball, const auto& visit) { return CloudWalk(cloud, scale, ball).run(visit); };
}

}  // namespace

CloudIndex::CloudIndex(const PlacedCloud& cloud)
    : cloud_(cloud),
      metric_(cloud.frame()),
      scale_(shortestStep(cloud.frame())),
      extent_(cloud.bounds().min.cwiseAbs().cwiseMax(cloud.bounds().max.cwiseAbs()).maxCoeff()),
      cell_(cloud.stretch() * cloud.points()->usualSpacing()) {}

std::size_t CloudIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent_));
  return CloudWalk(cloud_, scale_, ball).run(visit);
}

std::size_t CloudIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                              FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent_));
  return sweepCells(ball, motion.norm(), soon, walkIn(cloud_, scale_), visit);
}

std::size_t CloudIndex::nearest(const Vec3& centre, double farthest,
                                FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const Box bounds = cloud_.bounds();
  const double size = bounds.size().norm() + (centre - bounds.centre()).norm();
  return nearestCell(ball, farthest, cell_, std::max(size, extent_), walkIn(cloud_, scale_), visit);
}

IndexStats CloudIndex::stats() const {
  const CloudPoints& points = *cloud_.points();
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = points.levels();
  stats.leaves = points.blocks();
  for (int level = 1; level < points.levels(); ++level) stats.nodes += points.countOn(level);
  return stats;
}

}  // namespace hl
