#include "surfaces/walked_index.h"

#include <algorithm>

#include "surfaces/cell_search.h"

namespace hl {

WalkedIndex::WalkedIndex(const GridFrame& frame, const Box& bounds, double cell)
    : bounds_(bounds),
      metric_(frame),
      scale_(shortestStep(frame)),
      extent_(bounds.empty() ? 0 : bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).maxCoeff()),
      cell_(cell) {}

std::size_t WalkedIndex::overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId)> visit) const {
  const GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent_));
  return walk(ball, visit);
}

// When it stops, nearly nothing is near enough.
std::size_t WalkedIndex::overlapUntil(const Vec3& centre, double radius, FunctionRef<bool(ElementId)> stop) const {
  GridBall ball(metric_, centre, Vec3::Zero(), reachOf(radius, centre, Vec3::Zero(), extent_));
  bool stopped = false;
  return walk(ball, [&](ElementId primitive) {
    if (stopped) return;
    stopped = stop(primitive);
    if (stopped) ball.setRadius(0);
  });
}

std::size_t WalkedIndex::sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                               FunctionRef<double(ElementId, double)> visit) const {
  const GridBall ball(metric_, from, motion, reachOf(radius, from, motion, extent_));
  const auto walking = [this](const GridBall& part, const auto& each) { return walk(part, each); };
  return sweepCells(ball, motion.norm(), soon, walking, visit);
}

std::size_t WalkedIndex::nearest(const Vec3& centre, double farthest,
                                 FunctionRef<double(ElementId, double)> visit) const {
  if (bounds_.empty()) return 0;
  const GridBall ball(metric_, centre, Vec3::Zero(), 0);
  const double size = bounds_.size().norm() + (centre - bounds_.centre()).norm();
  const auto walking = [this](const GridBall& part, const auto& each) { return walk(part, each); };
  return nearestCell(ball, farthest, cell_, std::max(size, extent_), walking, visit);
}

}  // namespace hl
