// The first part of building a WideBvh: a binary tree of boxes whose leaves are runs of eight primitives.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/float_box.h"
#include "geometry/primitive.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// A primitive during the build: its box, rounded outward, with its number in the unused lanes.
struct BoxedPrimitive {
  FloatBox box;
  // Stored as two numbers: the bits of an integer could be a denormal float, which slows arithmetic down.
  void setNumber(std::uint32_t number) {
    box.min[3] = static_cast<float>(number & 0xffffu);
    box.max[3] = static_cast<float>(number >> 16);
  }
  std::uint32_t number() const {
    return static_cast<std::uint32_t>(box.min[3]) | static_cast<std::uint32_t>(box.max[3]) << 16;
  }
};

/// Children are links: kBlockLink | block, or a node.
struct BinaryNode {
  FloatBox box;
  std::array<std::uint32_t, 2> child{};
};

struct BinaryTree {
  std::vector<BoxedPrimitive> primitives;  ///< block k holds primitives 8 k to 8 (k + 1) - 1
  std::vector<BinaryNode> nodes;           ///< node k splits before block k, so node 0 is unused
  std::vector<FloatBox> blocks;
  std::uint32_t root = kBlockLink;

  const FloatBox& box(std::uint32_t link) const { return isBlock(link) ? blocks[link & ~kBlockLink] : nodes[link].box; }
};

/// Splits `primitives` (at least one) by the surface area heuristic. O(n lg n), parallel; the result does not depend on
/// the number of threads.
BinaryTree buildBinaryTree(std::vector<BoxedPrimitive> primitives);

}  // namespace hl
