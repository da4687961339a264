// DepthIndex: finds the triangles of a depth image near a moving ball, by its tiles (depth_walk.h).
#pragma once

#include <cstddef>

#include "geometry/spatial_index.h"
#include "surfaces/depth_frame.h"
#include "surfaces/grid_ball.h"

namespace hl {

class DepthIndex final : public SpatialIndex {
 public:
  /// The frame must outlive it.
  explicit DepthIndex(const DepthFrame& frame);

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  std::size_t nearest(const Vec3& centre, double farthest,
                      FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

 private:
  const DepthFrame& frame_;
  const GridMetric metric_;
  const double extent_, cell_;  // m: largest absolute coordinate, and about the size of a cell
};

}  // namespace hl
