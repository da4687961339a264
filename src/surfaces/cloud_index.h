// CloudIndex: finds the points or surfels of a cloud near a moving ball, by the bounds of its blocks.
#pragma once

#include <cstddef>

#include "geometry/spatial_index.h"
#include "surfaces/grid_ball.h"
#include "surfaces/placed_cloud.h"

namespace hl {

class CloudIndex final : public SpatialIndex {
 public:
  /// The cloud must outlive it. Takes no memory: the bounds are those of its points.
  explicit CloudIndex(const PlacedCloud& cloud);

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  std::size_t nearest(const Vec3& centre, double farthest,
                      FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

 private:
  const PlacedCloud& cloud_;
  const GridMetric metric_;
  const Vec3 scale_;            // shortestStep()
  const double extent_, cell_;  // m: largest absolute coordinate, and spacing of the points
};

}  // namespace hl
