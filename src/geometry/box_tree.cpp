#include "geometry/box_tree.h"

#include <algorithm>

namespace hl {

namespace {

constexpr std::size_t kLeaf = 4;  // boxes

Vec3 doubleCentre(const Box& box) { return box.min + box.max; }

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) boxes_.push_back({boxes[i], i});
  }
  if (boxes_.empty()) return;
  nodes_.reserve(boxes_.size());
  build(0, boxes_.size());
}

// Boxes with the same centre are ordered by their number, so that the same boxes give the same tree.
void BoxTree::build(std::size_t begin, std::size_t end) {
  const std::size_t own = nodes_.size();
  Node node;
  Box centres;
  for (std::size_t i = begin; i < end; ++i) {
    node.box.extend(boxes_[i].box);
    centres.extend(doubleCentre(boxes_[i].box));
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) {
    nodes_[own].begin = static_cast<std::uint32_t>(begin);
    nodes_[own].end = static_cast<std::uint32_t>(end);
  } else {
    Eigen::Index axis = 0;
    centres.size().maxCoeff(&axis);
    const auto before = [axis](const Numbered& a, const Numbered& b) {
      const double at_a = doubleCentre(a.box)[axis], at_b = doubleCentre(b.box)[axis];
      return at_a != at_b ? at_a < at_b : a.number < b.number;
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = boxes_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end), before);
    build(begin, middle);
    build(middle, end);
  }
  nodes_[own].past = static_cast<std::uint32_t>(nodes_.size());
}

void BoxTree::visitMet(const Box& region, FunctionRef<void(std::uint32_t)> visit) const {
  for (std::size_t at = 0; at < nodes_.size();) {
    const Node& node = nodes_[at];
    if (!node.box.meets(region)) {
      at = node.past;
      continue;
    }
    for (std::size_t i = node.begin; i < node.end; ++i) {
      if (boxes_[i].box.meets(region)) visit(boxes_[i].number);
    }
    ++at;
  }
}

}  // namespace hl
