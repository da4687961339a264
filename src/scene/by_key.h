// The objects of a scene in the order of their keys, which is the same from frame to frame.
#pragma once

#include <algorithm>
#include <vector>

namespace hl {

/// Pointers to all elements of a range of Instance or PlacedShape, sorted by key; valid as long as the range. The
/// elements are large: sorting pointers moves none of them. Allocates.
template <typename Range>
auto pointersByKey(Range& range) {
  std::vector<decltype(&*range.begin())> pointers;
  pointers.reserve(range.size());
  for (auto& one : range) pointers.push_back(&one);
  std::sort(pointers.begin(), pointers.end(), [](const auto* a, const auto* b) { return a->key < b->key; });
  return pointers;
}

}  // namespace hl
