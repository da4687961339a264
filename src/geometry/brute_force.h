// BruteForceIndex: proposes every primitive to every query. The reference for all other structures, and `--hierarchy
// none`.
#pragma once

#include "geometry/spatial_index.h"

namespace hl {

/// See SpatialIndex; stores only the number of primitives.
class BruteForceIndex final : public SpatialIndex {
 public:
  explicit BruteForceIndex(std::size_t primitives) : primitives_(primitives) {}
  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

 private:
  std::size_t primitives_;
};

}  // namespace hl
