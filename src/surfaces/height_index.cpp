#include "surfaces/height_index.h"

#include "surfaces/height_walk.h"

namespace hl {

HeightIndex::HeightIndex(const HeightGrid& grid, const HeightPyramid& pyramid, const GridFrame& frame,
                         const Box& bounds)
    : WalkedIndex(frame, bounds, frame.axes.col(0).norm() + frame.axes.col(1).norm()), grid_(grid), pyramid_(pyramid) {}

std::size_t HeightIndex::walk(const GridBall& ball, Visit visit) const {
  return HeightWalk(grid_, pyramid_, ball).run(visit);
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
