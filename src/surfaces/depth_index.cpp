#include "surfaces/depth_index.h"

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
    : WalkedIndex(frame.frame(), frame.bounds(), cellOf_m(frame)), frame_(frame) {}

std::size_t DepthIndex::walk(const GridBall& ball, Visit visit) const { return DepthWalk(frame_, ball).run(visit); }

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
