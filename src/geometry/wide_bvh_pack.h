// The second half of building a WideBvh: the binary tree becomes nodes of eight children, its runs become blocks.
#pragma once

#include <span>
#include <vector>

#include "geometry/primitive.h"
#include "geometry/wide_bvh_build.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// A primitive's box relative to `origin`, rounded outward.
BoxedPrimitive boxed(const Primitive& primitive, std::uint32_t number, const Vec3& origin);

/// Nodes in depth-first order, none for a tree of one block; `depth` becomes the number of nodes on the longest path.
std::vector<WideNode> widen(const BinaryTree& tree, int& depth);

/// Blocks count as at least `smallest` (m) large, which keeps the coordinates of a query in their steps in range.
std::vector<WideBlock> pack(const BinaryTree& tree, std::span<const Primitive> primitives, const Vec3& origin,
                            double smallest);

}  // namespace hl
