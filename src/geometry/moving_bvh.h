// MovingBvh: queries of a deforming mesh at a moment between two shapes. Its vertices move on straight lines. So the
// contents of a box of the first shape and of the same box of the second always lie within the box interpolated between
// the two. The hierarchies of both shapes, which are the same tree, are traversed together.
#pragma once

#include "geometry/spatial_index.h"
#include "geometry/wide_bvh.h"

namespace hl {

/// A view for one query or a few; made on the stack. RT-safe.
class MovingBvh final : public SpatialIndex {
 public:
  /// `from` and `to`, which must outlive this object, are the same tree (WideBvh::isTreeOf). A query covers all
  /// fractions of the transition from `begin` to `end`, 0 <= begin <= end <= 1: it finds what is near at any of them.
  MovingBvh(const WideBvh& from, const WideBvh& to, double begin, double end)
      : from_(from), to_(to), begin_(begin), end_(end) {}
  MovingBvh(const WideBvh& from, const WideBvh& to, double part) : MovingBvh(from, to, part, part) {}

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override { return to_.stats(); }

 private:
  const WideBvh& from_;
  const WideBvh& to_;
  const double begin_, end_;
};

}  // namespace hl
