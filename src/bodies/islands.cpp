#include "bodies/islands.h"

#include <algorithm>
#include <numeric>

namespace hl {

Islands::Islands(std::size_t most_nodes, std::size_t most_rows) {
  parent_.reserve(most_nodes);
  place_.reserve(most_nodes + 1);
  sorted_.reserve(most_rows);
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

// By counting: how many rows are in the islands before.
void Islands::gather(std::vector<Row>& rows, std::size_t nodes) {
  begin(nodes);
  for (const Row& row : rows) {
    if (row.b != Row::kFixed) join(row.a, row.b);
  }
  place_.assign(nodes + 1, 0);
  for (const Row& row : rows) ++place_[static_cast<std::size_t>(of(row.a)) + 1];
  std::partial_sum(place_.begin(), place_.end(), place_.begin());
  sorted_.resize(rows.size());
  for (const Row& row : rows) sorted_[place_[static_cast<std::size_t>(of(row.a))]++] = row;
  rows.swap(sorted_);
}

std::size_t Islands::endOf(std::span<const Row> rows, std::size_t begin) {
  const int island = of(rows[begin].a);
  std::size_t end = begin;
  while (end < rows.size() && of(rows[end].a) == island) ++end;
  return end;
}

}  // namespace hl
