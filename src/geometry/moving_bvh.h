// MovingBvh: a mesh on its way from one place to another, asked at a moment between. Its vertices move on straight
// lines, so what two boxes hold at the two ends lies, at every moment between, within the box between those two: the
// hierarchies of both ends, which are one tree, are walked as one.
#pragma once

#include "geometry/spatial_index.h"
#include "geometry/wide_bvh.h"

namespace hl {

/// A view for one question or some; made on the stack. RT-safe.
class MovingBvh final : public SpatialIndex {
 public:
  /// `from` and `to`, which must outlive it, are the same tree (WideBvh::isTreeOf). At all parts of the way from
  /// `begin` to `end`, 0 <= begin <= end <= 1: what comes near at any of them is near.
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
