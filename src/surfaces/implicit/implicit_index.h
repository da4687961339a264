// ImplicitIndex: finds the triangles of an implicit surface near a moving ball: of each sheet, by its bricks.
#pragma once

#include <vector>

#include "surfaces/implicit/known_bricks.h"
#include "surfaces/implicit/sheet.h"
#include "surfaces/walked_index.h"

namespace hl {

class ImplicitIndex final : public WalkedIndex {
 public:
  /// `frame`: from the function's coordinates to m. The sheets must outlive it. `cell`: m, size of the least cell.
  /// Setup only: it looks for large bricks, which takes up to some 0.1 s.
  ImplicitIndex(const std::vector<Sheet>& sheets, const GridFrame& frame, const Box& bounds, double cell);

  IndexStats stats() const override;

 private:
  std::size_t walk(const GridBall& ball, Visit visit) const override;

  const std::vector<Sheet>& sheets_;
  std::vector<KnownBricks> known_;  // of each sheet
  const GridFrame frame_;
};

}  // namespace hl
