#include "surfaces/implicit/implicit_index.h"

#include <algorithm>

#include "surfaces/brick_walk.h"
#include "surfaces/implicit/sheet_bricks.h"

namespace hl {

// A look at a brick costs as much as its function has bodies.
std::size_t ImplicitIndex::walk(const GridBall& ball, Visit visit) const {
  std::size_t looked = 0;
  for (const Sheet& sheet : sheets_) {
    SheetBricks bricks(sheet, frame_, &ball);
    looked += sheet.smooth().bodies() * BrickWalk(bricks, scale(), ball).run(visit);
  }
  return looked;
}

// There are no nodes: bricks are computed.
IndexStats ImplicitIndex::stats() const {
  IndexStats stats;
  stats.bytes = sizeof(*this);
  for (const Sheet& sheet : sheets_) stats.depth = std::max(stats.depth, sheet.levels());
  return stats;
}

}  // namespace hl
