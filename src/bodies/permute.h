// Permute: brings things that are costly to move into an order that was found by their numbers: each is moved once,
// along the cycles of the permutation, and nothing is allocated.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace hl {

/// Afterwards `items[i]` is what items[from(i)] was, for the first `count` of them. from(i) is a reference to a number,
/// all of them a permutation, and is used up. RT-safe.
template <typename Item, typename From>
void permute(Item* items, std::size_t count, const From& from) {
  for (std::size_t begin = 0; begin < count; ++begin) {
    if (static_cast<std::size_t>(from(begin)) == begin) continue;
    const Item kept = items[begin];
    std::size_t here = begin;
    while (true) {
      using Number = std::remove_cvref_t<decltype(from(here))>;
      const auto next = static_cast<std::size_t>(std::exchange(from(here), static_cast<Number>(here)));
      if (next == begin) break;
      items[here] = items[next];
      here = next;
    }
    items[here] = kept;
  }
}

}  // namespace hl
