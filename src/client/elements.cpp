#include "client/elements.h"

#include <algorithm>

namespace hl::client {

namespace {

// A table of all numbers from the least to the largest that is named takes no more memory than so many lists of them.
constexpr std::size_t kMaxPerIndex = 4;

// Replaces each number by its place among those named, by a table.
void numberByTable(Elements& elements, std::uint32_t least, std::size_t range) {
  std::vector<std::uint32_t> place(range, 0);  // 1 for a number that is named, then its place
  for (const std::uint32_t index : elements.order) place[index - least] = 1;
  for (std::size_t i = 0; i < range; ++i) {
    if (place[i] == 0) continue;
    place[i] = static_cast<std::uint32_t>(elements.vertices.size());
    elements.vertices.push_back(least + static_cast<std::uint32_t>(i));
  }
  for (std::uint32_t& index : elements.order) index = place[index - least];
}

// The same by searching a sorted list.
void numberBySearch(Elements& elements) {
  std::vector<std::uint32_t>& vertices = elements.vertices;
  vertices = elements.order;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (std::uint32_t& index : elements.order) {
    index = static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), index) - vertices.begin());
  }
}

}  // namespace

Elements elementsOf(const Indices& indices, std::size_t count) {
  Elements elements;
  if (count == 0) return elements;
  elements.order.reserve(count);
  for (std::size_t i = 0; i < count; ++i) elements.order.push_back(indices.at(i));
  const auto [least, most] = std::minmax_element(elements.order.begin(), elements.order.end());
  const std::size_t range = std::size_t{*most} - *least + 1;
  if (range <= kMaxPerIndex * count) {
    numberByTable(elements, *least, range);
  } else {
    numberBySearch(elements);
  }
  return elements;
}

}  // namespace hl::client
