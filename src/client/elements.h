// Elements: what hlDrawElements draws. A mesh names each vertex some six times; it is kept, sent and moved once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/arrays.h"

namespace hl::client {

struct Elements {
  std::vector<std::uint32_t> vertices;  ///< of the arrays, those that are named: each once, ascending
  std::vector<std::uint32_t> order;     ///< in the order drawn, places in `vertices`
};

/// Of the first `count` indices. O(count), or O(count lg count) where they name few vertices far apart.
Elements elementsOf(const Indices& indices, std::size_t count);

}  // namespace hl::client
