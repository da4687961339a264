// HeightIndex: finds the triangles of a height field near a moving ball, by the pyramid of its slabs.
//
// The test of a slab, in grid coordinates (grid_ball.h). The lower side of a ball lies above a paraboloid: for every
// k > 0, as 2 sqrt(s) <= k + s / k,
//   w >= c_w - b.d - (k + rho^2 / k) / 2 + curve.d^2 / (2 k),
// and touches it where the slope is that of the slab, if k = rho / sqrt(1 + sum (slope + b)^2 / curve). A slab that
// lies below the paraboloid over the whole block cannot be touched. For curve diagonal the two directions are apart,
// and the least distance is a closed form. A ball above a smooth surface thus leaves but a few blocks of each level.
#pragma once

#include <cstddef>

#include "surfaces/height_grid.h"
#include "surfaces/height_pyramid.h"
#include "surfaces/walked_index.h"

namespace hl {

class HeightIndex final : public WalkedIndex {
 public:
  /// Grid and pyramid must outlive it. `bounds`: m, of the field.
  HeightIndex(const HeightGrid& grid, const HeightPyramid& pyramid, const GridFrame& frame, const Box& bounds);

  IndexStats stats() const override;

 private:
  std::size_t walk(const GridBall& ball, Visit visit) const override;

  const HeightGrid& grid_;
  const HeightPyramid& pyramid_;
};

}  // namespace hl
