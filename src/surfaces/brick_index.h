// BrickIndex: finds the triangles of an iso surface near a moving ball, by the pyramid of its bricks.
#pragma once

#include "surfaces/iso_cells.h"
#include "surfaces/walked_index.h"

namespace hl {

class BrickIndex final : public WalkedIndex {
 public:
  /// The cells must outlive it. `bounds`: of the surface, m. Takes no memory: the pyramid is the volume's.
  BrickIndex(const IsoCells& cells, const Box& bounds);

  double cellSize_m() const override { return cell_m(); }
  IndexStats stats() const override;

 private:
  std::size_t walk(const GridBall& ball, Visit visit) const override;

  const IsoCells& cells_;
};

}  // namespace hl
