// BrickIndex: finds the triangles of an iso surface near a moving ball, by the pyramid of its bricks.
#pragma once

#include <cstddef>

#include "geometry/box.h"
#include "geometry/spatial_index.h"
#include "surfaces/grid_ball.h"
#include "surfaces/iso_cells.h"

namespace hl {

class BrickIndex final : public SpatialIndex {
 public:
  /// The cells must outlive it. `bounds`: of the surface, m. Takes no memory: the pyramid is the volume's.
  BrickIndex(const IsoCells& cells, const Box& bounds);

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  std::size_t nearest(const Vec3& centre, double farthest,
                      FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

 private:
  const IsoCells& cells_;
  const Box bounds_;
  const GridMetric metric_;
  const Vec3 scale_;            // m per step along each axis: shortestStep()
  const double extent_, cell_;  // m: largest absolute coordinate, and size of a cell
};

}  // namespace hl
