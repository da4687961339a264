// BoxTree: finds the boxes that meet a region: the hierarchy over the objects of a scene, as WideBvh is over the
// primitives of one object. It is split at the median of the longest side. It is built anew for each frame in O(n lg
// n): a refitted tree would be worse if objects have moved far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "geometry/box.h"

namespace hl {

/// Immutable; queries are const, RT-safe and may run on many threads at once.
class BoxTree {
 public:
  BoxTree() = default;
  /// Empty boxes are never found. Allocates.
  explicit BoxTree(std::span<const Box> boxes);

  /// Visits every box that meets the region once, by its number, in an order that depends only on the boxes. `visit`
  /// may shrink the region for the boxes still to come.
  void visitMet(const Box& region, FunctionRef<void(std::uint32_t box)> visit) const;
  std::size_t bytes() const { return nodes_.capacity() * sizeof(Node) + boxes_.capacity() * sizeof(Numbered); }

 private:
  // In depth-first order: the first child follows its parent, and `past` is the node after the last descendant. So a
  // traversal needs no stack.
  struct Node {
    Box box;
    std::uint32_t past = 0;
    std::uint32_t begin = 0, end = 0;  // range in boxes_ of a leaf; empty for inner nodes
  };
  struct Numbered {
    Box box;
    std::uint32_t number = 0;
  };

  void build(std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<Numbered> boxes_;
};

}  // namespace hl
