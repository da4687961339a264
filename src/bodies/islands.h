// Islands: the bodies and hands that rows and joints connect, directly or by others. Each is solved on its own.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "bodies/row.h"

namespace hl {

/// By one thread at a time.
class Islands {
 public:
  explicit Islands(std::size_t most_nodes);

  /// Each node for itself. RT-safe, as all below.
  void begin(std::size_t nodes);
  void join(int a, int b);
  /// The lowest number of a node in the island.
  int of(int node);
  /// Brings the items of each island together, those of the lowest first, in the order in which they are. `node_of`: a
  /// node of an item. `room`: as large as `items` may be.
  template <typename Item, typename NodeOf>
  void gather(std::vector<Item>& items, std::vector<Item>& room, NodeOf node_of);

 private:
  std::vector<int> parent_;
  std::vector<std::size_t> place_;
};

// By counting: how many items are in the islands before.
template <typename Item, typename NodeOf>
void Islands::gather(std::vector<Item>& items, std::vector<Item>& room, NodeOf node_of) {
  const auto island_of = [&](const Item& item) { return of(node_of(item)); };
  const bool in_order = std::is_sorted(items.begin(), items.end(), [&](const Item& one, const Item& other) {
    return island_of(one) < island_of(other);
  });
  if (in_order) return;
  place_.assign(parent_.size() + 1, 0);
  for (const Item& item : items) ++place_[static_cast<std::size_t>(of(node_of(item))) + 1];
  std::partial_sum(place_.begin(), place_.end(), place_.begin());
  room.resize(items.size());
  for (const Item& item : items) room[place_[static_cast<std::size_t>(of(node_of(item)))]++] = item;
  items.swap(room);
}

}  // namespace hl
