// BoxTree: finds which of many boxes meet a region: the hierarchy over the objects of a scene, as WideBvh is over the
// primitives of one. Halved at the median of the longest side, and made anew for each frame in n lg n steps: a tree
// kept from the frame before would be worse wherever objects have moved far.
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

  /// Visits every box that meets the region, by its number, once, in an order that only the boxes decide. `visit` may
  /// make the region smaller for those to come.
  void visitMet(const Box& region, FunctionRef<void(std::uint32_t box)> visit) const;
  std::size_t bytes() const { return nodes_.capacity() * sizeof(Node) + boxes_.capacity() * sizeof(Numbered); }

 private:
  // In the order of a walk from the root, so that what follows a node is its first child, and `past` the node after its
  // last descendant: a walk needs no stack.
  struct Node {
    Box box;
    std::uint32_t past = 0;
    std::uint32_t begin = 0, end = 0;  // of boxes_; a leaf's own, else none
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
