#include "surfaces/depth_index.h"

#include "surfaces/depth_walk.h"

namespace hl {

namespace {

// Of the nearest triangles.
double cellOf_m(const DepthCells& cells) {
  const DepthCamera& camera = cells.image()->camera;
  return cells.image()->tiles.all().low *
         (cells.frame().axes.col(0).norm() / camera.fx + cells.frame().axes.col(1).norm() / camera.fy);
}

}  // namespace

DepthIndex::DepthIndex(const DepthCells& cells, const Box& bounds)
    : WalkedIndex(cells.frame(), bounds, cellOf_m(cells)), cells_(cells) {}

std::size_t DepthIndex::walk(const GridBall& ball, Visit visit) const { return DepthWalk(cells_, ball).run(visit); }

IndexStats DepthIndex::stats() const {
  const DepthTiles& tiles = cells_.image()->tiles;
  IndexStats stats;
  stats.bytes = sizeof(*this);
  stats.depth = tiles.levels();
  stats.leaves = std::size_t{tiles.columns(0)} * tiles.rows(0);
  for (int level = 1; level < tiles.levels(); ++level)
    stats.nodes += std::size_t{tiles.columns(level)} * tiles.rows(level);
  return stats;
}

}  // namespace hl
