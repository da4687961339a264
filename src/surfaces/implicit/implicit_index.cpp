#include "surfaces/implicit/implicit_index.h"

#include <algorithm>

#include "surfaces/brick_walk.h"
#include "surfaces/implicit/find_bricks.h"
#include "surfaces/implicit/sheet_bricks.h"

namespace hl {

namespace {

constexpr std::size_t kMaxKnown = 1U << 15;  // bricks of all sheets together

}  // namespace

ImplicitIndex::ImplicitIndex(const std::vector<Sheet>& sheets, const GridFrame& frame, const Box& bounds, double cell)
    : WalkedIndex(frame, bounds, cell), sheets_(sheets), frame_(frame) {
  for (const Sheet& sheet : sheets) known_.push_back(findBricks(sheet, kMaxKnown / sheets.size()));
}

// A look at a brick costs as much as its function has bodies.
std::size_t ImplicitIndex::walk(const GridBall& ball, Visit visit) const {
  std::size_t looked = 0;
  for (std::size_t i = 0; i < sheets_.size(); ++i) {
    SheetBricks bricks(sheets_[i], frame_, &ball, &known_[i]);
    looked += BrickWalk(bricks, scale(), ball).run(visit);
  }
  return looked;
}

// There are no nodes: most bricks are computed.
IndexStats ImplicitIndex::stats() const {
  IndexStats stats;
  stats.bytes = sizeof(*this);
  for (const Sheet& sheet : sheets_) stats.depth = std::max(stats.depth, sheet.levels());
  for (const KnownBricks& known : known_) stats.bytes += known.bytes();
  return stats;
}

}  // namespace hl
