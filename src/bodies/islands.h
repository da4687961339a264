// Islands: the bodies and hands that rows join, directly or by others. Each is solved on its own.
#pragma once

#include <span>
#include <vector>

#include "bodies/row.h"

namespace hl {

/// By one thread at a time.
class Islands {
 public:
  Islands(std::size_t most_nodes, std::size_t most_rows);

  /// Each node for itself. RT-safe.
  void begin(std::size_t nodes);
  void join(int a, int b);
  /// The lowest number of a node in the island.
  int of(int node);
  /// Brings the rows of each island together, those of the lowest first, in the order in which they are; then rowsOf()
  /// tells which they are. RT-safe.
  void gather(std::vector<Row>& rows, std::size_t nodes);
  /// The first after `begin` that belongs to another island.
  std::size_t endOf(std::span<const Row> rows, std::size_t begin);

 private:
  std::vector<int> parent_;
  std::vector<std::size_t> place_;
  std::vector<Row> sorted_;
};

}  // namespace hl
