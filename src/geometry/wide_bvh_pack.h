// The second part of building a WideBvh: the binary tree is converted to nodes of eight children, its runs to blocks.
#pragma once

#include <span>
#include <vector>

#include "base/huge_pages.h"
#include "geometry/primitives.h"
#include "geometry/wide_bvh_build.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// The box of a primitive's corners relative to `origin`, rounded outward.
BoxedPrimitive boxed(const std::array<Vec3, 3>& corners, std::uint32_t number, const Vec3& origin);

/// Nodes in depth-first order, without frames and boxes; none for a tree of one block. `depth` is set to the number of
/// nodes on the longest path.
HugeVector<WideNode> widen(const BinaryTree& tree, int& depth);

/// Origin of the coordinates of blocks, and their minimum size. Smaller blocks count as `smallest` (m), so that the
/// coordinates of a query in quantisation steps stay in range.
struct BlockScale {
  Vec3 origin;
  double smallest;
};

HugeVector<WideBlock> pack(const BinaryTree& tree, const Primitives& primitives, const BlockScale& scale);

/// The same primitives in the same lanes, at their current positions.
HugeVector<WideBlock> repack(const HugeVector<WideBlock>& blocks, const Primitives& moved, const BlockScale& scale);

}  // namespace hl
