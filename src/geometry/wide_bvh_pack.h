// The second half of building a WideBvh: the binary tree becomes nodes of eight children, its runs become blocks.
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

/// Nodes in depth-first order, their frames and boxes not set yet; none for a tree of one block; `depth` becomes the
/// number of nodes on the longest path.
HugeVector<WideNode> widen(const BinaryTree& tree, int& depth);

/// What the coordinates of blocks are relative to. Blocks count as at least `smallest` (m) large, which keeps the
/// coordinates of a query in their steps in range.
struct BlockScale {
  Vec3 origin;
  double smallest;
};

HugeVector<WideBlock> pack(const BinaryTree& tree, const Primitives& primitives, const BlockScale& scale);

/// The same primitives in the same lanes, where they are now.
HugeVector<WideBlock> repack(const HugeVector<WideBlock>& blocks, const Primitives& moved, const BlockScale& scale);

}  // namespace hl
