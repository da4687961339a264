#include "bodies/islands.h"

#include <algorithm>

namespace hl {

Islands::Islands(std::size_t most_nodes) {
  parent_.reserve(most_nodes);
  place_.reserve(most_nodes + 1);
}

void Islands::begin(std::size_t nodes) {
  parent_.resize(nodes);
  std::iota(parent_.begin(), parent_.end(), 0);
}

int Islands::of(int node) {
  while (parent_[static_cast<std::size_t>(node)] != node) {
    int& parent = parent_[static_cast<std::size_t>(node)];
    parent = parent_[static_cast<std::size_t>(parent)];
    node = parent;
  }
  return node;
}

void Islands::join(int a, int b) {
  a = of(a);
  b = of(b);
  parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

}  // namespace hl
