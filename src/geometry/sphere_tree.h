// SphereTree: the paper's hierarchy (section 6.2, after Quinlan 1994). Each primitive is covered with small spheres by
// scan conversion. A binary tree over the spheres is split at the middle of the longest axis of the box of leaf
// centres. A node contains all leaf spheres below it, not its child nodes; its radius is the smaller of two heuristics.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/primitives.h"
#include "geometry/spatial_index.h"

namespace hl {

/// See SpatialIndex. Immutable once built; may be moved and copied.
class SphereTree final : public SpatialIndex {
 public:
  /// Rounded outward: contains the sphere from which it was computed in double precision.
  struct Sphere {
    std::array<float, 3> centre{};
    float radius = 0;
  };
  /// Covers a part of one primitive.
  struct Leaf {
    Sphere sphere;
    std::uint32_t primitive = 0;
  };
  /// child >= 0: index into nodes(); child < 0: leaf number ~child of leaves().
  struct Node {
    Sphere sphere;
    std::array<std::int32_t, 2> child{};
  };

  /// Builds in O(n lg n); at most 64 leaves per primitive. Setup only. Empty input gives an index that visits nothing.
  static SphereTree build(const Primitives& primitives);

  std::size_t overlap(const Vec3& centre, double radius, FunctionRef<void(ElementId primitive)> visit) const override;
  std::size_t sweep(const Vec3& from, const Vec3& motion, double radius, double soon,
                    FunctionRef<double(ElementId primitive, double limit)> visit) const override;
  IndexStats stats() const override;

  std::span<const Node> nodes() const { return nodes_; }  ///< nodes()[0] is the root; a single leaf has no node
  std::span<const Leaf> leaves() const { return leaves_; }

 private:
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  int depth_ = 0;
};

}  // namespace hl
