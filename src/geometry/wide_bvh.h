// WideBvh: the default hierarchy. Boxes with eight children each, split by the surface area heuristic (Goldsmith and
// Salmon 1987; in bins after Wald 2007), above blocks of eight primitives packed in 16-bit coordinates. What a block
// proposes is decided by lower bounds of the true distance, not by boxes, so few candidates need the exact test.
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

/// See SpatialIndex; both queries propose a primitive once. Immutable once built; may be moved and copied.
/// Coordinates up to 1e15 m.
class WideBvh final : public SpatialIndex {
 public:
  /// Builds in O(n lg n) on all threads that oneTBB has; the result does not depend on their number. Setup only. Empty
  /// input gives an index that visits nothing.
  static WideBvh build(const Primitives& primitives);

  /// The same tree around the same primitives where they are now: as many, numbered as before. O(n) on all threads that
  /// oneTBB has; the result does not depend on their number. Setup only.
  WideBvh refit(const Primitives& moved) const;
  /// Whether one was refitted from the other, or both from a third: node for node and block for block the same tree.
  bool isTreeOf(const WideBvh& other) const { return tree_number_ == other.tree_number_; }
  /// Boxes that a query enters in the mean, by the surface area heuristic: small ones that it meets anywhere in the
  /// root's box.
  double cost() const { return cost_; }
  /// The same in multiples of what it was when the tree was built.
  double costRatio() const { return cost_ == 0 ? 1 : cost_ / built_cost_; }

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

  std::span<const WideNode> nodes() const { return nodes_; }  ///< nodes()[0] is the root; one block alone has no node
  std::span<const WideBlock> blocks() const { return blocks_; }
  std::size_t primitives() const { return primitives_; }
  const Vec3& origin() const { return origin_; }  ///< what the coordinates of nodes and blocks are relative to
  double extent() const { return extent_; }       ///< m: largest coordinate of a primitive

 private:
  // Origin, extent and half of it from where the primitives are.
  void measure(const Primitives& primitives);
  BlockScale scale() const;
  WideTree tree() const;
  // The radius, and what the double tests of the candidates may be off by.
  double reach(const Vec3& from, const Vec3& motion, double radius) const;

  HugeVector<WideNode> nodes_;
  HugeVector<WideBlock> blocks_;
  std::size_t primitives_ = 0;
  std::uint64_t tree_number_ = 0;  // of the build that it comes from
  Vec3 origin_ = Vec3::Zero();
  double extent_ = 0;
  double half_ = 0;  // m: the same, relative to origin_
  int depth_ = 0;
  double cost_ = 0, built_cost_ = 0;
};

}  // namespace hl
