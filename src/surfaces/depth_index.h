// DepthIndex: finds the triangles of a depth image near a moving ball, by its tiles (depth_walk.h).
#pragma once

#include <cstddef>

#include "surfaces/depth_cells.h"
#include "surfaces/walked_index.h"

namespace hl {

class DepthIndex final : public WalkedIndex {
 public:
  /// The cells must outlive it. `bounds`: of the triangles.
  DepthIndex(const DepthCells& cells, const Box& bounds);

  IndexStats stats() const override;

 private:
  std::size_t walk(const GridBall& ball, Visit visit) const override;

  const DepthCells& cells_;
};

}  // namespace hl
