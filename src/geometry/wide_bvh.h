// WideBvh: the default hierarchy. Boxes with eight children each, split by the surface area heuristic (Goldsmith and
// Salmon 1987; binned as in Wald 2007), above blocks of eight primitives quantised to 16-bit coordinates. The
// candidates of a block are chosen by lower bounds of the true distance, not by boxes, so few of them need the exact
// test.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/huge_pages.h"
#include "geometry/primitives.h"
#include "geometry/spatial_index.h"
#include "geometry/wide_bvh_layout.h"
#include "geometry/wide_bvh_pack.h"
#include "geometry/wide_bvh_query.h"

namespace hl {

/// See SpatialIndex; all queries propose each primitive once. Immutable once built; may be moved and copied.
/// Coordinates up to 1e15 m.
class WideBvh final : public SpatialIndex {
 public:
  /// Builds in O(n lg n) on all threads of oneTBB; the result does not depend on their number. Setup only. Empty input
  /// gives an index that visits nothing.
  static WideBvh build(const Primitives& primitives);

  /// The same tree with new bounds for the moved primitives; their number and numbering must not have changed. O(n) on
  /// all threads of oneTBB; the result does not depend on their number. Setup only.
  WideBvh refit(const Primitives& moved) const;
  /// Whether both come from the same build by refitting: their nodes and blocks correspond one to one.
  bool isTreeOf(const WideBvh& other) const { return tree_number_ == other.tree_number_; }
  /// Expected number of boxes that a small query in the root's box enters, by the surface area heuristic.
  double cost() const { return cost_; }
  /// cost() divided by its value when the tree was built.
  double costRatio() const { return cost_ == 0 ? 1 : cost_ / built_cost_; }

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t overlapUntil(const Vec3& centre, double radius,
                           FunctionRef<bool(ElementId primitive)> stop) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  std::size_t nearest(const Vec3& centre, double farthest,
                      FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

  std::span<const WideNode> nodes() const { return nodes_; }  ///< nodes()[0] is the root; a single block has no node
  std::span<const WideBlock> blocks() const { return blocks_; }
  std::size_t primitives() const { return primitives_; }
  const Vec3& origin() const { return origin_; }  ///< origin of the coordinates of nodes and blocks
  double extent() const { return extent_; }       ///< m: largest absolute coordinate of a primitive

 private:
  // Sets the origin and the extents from the positions of the primitives.
  void measure(const Primitives& primitives);
  BlockScale scale() const;
  WideTree tree() const;
  // The radius with a margin for the rounding of the double-precision tests of the candidates.
  double reach(const Vec3& from, const Vec3& motion, double radius) const;

  HugeVector<WideNode> nodes_;
  HugeVector<WideBlock> blocks_;
  std::size_t primitives_ = 0;
  std::uint64_t tree_number_ = 0;  // number of the build from which it comes
  Vec3 origin_ = Vec3::Zero();
  double extent_ = 0;
  double half_ = 0;  // m: the extent relative to origin_
  int depth_ = 0;
  double cost_ = 0, built_cost_ = 0;
};

}  // namespace hl
