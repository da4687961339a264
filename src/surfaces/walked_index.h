// WalkedIndex: the queries of an index whose primitives are found by a walk of a ball through the parts of a surface.
#pragma once

#include <cstddef>

#include "geometry/box.h"
#include "geometry/spatial_index.h"
#include "surfaces/grid_ball.h"

namespace hl {

class WalkedIndex : public SpatialIndex {
 public:
  /// `frame`: of the grid. `bounds`: of the surface, m. `cell`: m, size of a cell.
  WalkedIndex(const GridFrame& frame, const Box& bounds, double cell);

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const final;
  std::size_t overlapUntil(const Vec3& centre, double radius, FunctionRef<bool(ElementId primitive)> stop) const final;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const final;
  std::size_t nearest(const Vec3& centre, double farthest,
                      FunctionRef<double(ElementId primitive, double limit)> visit) const final;

 protected:
  using Visit = FunctionRef<void(ElementId primitive)>;
  /// As cell_search.h has it.
  virtual std::size_t walk(const GridBall& ball, Visit visit) const = 0;
  /// m per step along each axis: shortestStep().
  const Vec3& scale() const { return scale_; }
  /// m, size of a cell.
  double cell_m() const { return cell_; }

 private:
  const Box bounds_;
  const GridMetric metric_;
  const Vec3 scale_;
  const double extent_, cell_;  // m: largest absolute coordinate, and size of a cell
};

}  // namespace hl
