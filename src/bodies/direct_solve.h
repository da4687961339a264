// Direct solve: the impulses of an island as if its contacts stayed what they are: what bears load stays in touch, what
// sticks sticks, and what slips is dragged as it is. Sweeps need tens to hundreds of rounds to carry the load through a
// stack; this does it at once, and the sweeps after it find what was wrong in what it took for granted.
//
// For the rows J v = d it is the method of multipliers (R. T. Rockafellar, Mathematical Programming 5, 1973), with
// residuals r = d - J v and a weight W much above the masses:
//
//   (M + J' W J) dv = J' W r,   impulses += W (r - J dv)
//
// A stool with four legs has more rows than it can move; so the matrix is that of the bodies, not that of the rows.
#pragma once

#include <span>
#include <vector>

#include "bodies/block_cholesky.h"
#include "bodies/row.h"

namespace hl {

/// By one thread at a time.
class DirectSolve {
 public:
  explicit DirectSolve(std::size_t most_nodes) : local_(most_nodes, -1) { numbers_.reserve(most_nodes); }
  /// The rows are all of an island, prepared. False: there is no room, and nothing is changed. RT-safe.
  bool solve(std::span<Row> rows, std::span<Node> nodes, double period_s);

 private:
  bool assemble(std::span<const Row> rows, std::span<const Node> nodes);
  void number(std::span<const Row> rows, std::span<const Node> nodes);
  void addMasses(std::span<const Node> nodes);
  void addRow(const Row& row);
  void improve(std::span<Row> rows, std::span<Node> nodes, double period_s);
  void push(const Row& row, const Vec3& impulse);
  Vec3 moved(const Row& row);
  bool moves(int node) const { return node != Row::kFixed && local_[static_cast<std::size_t>(node)] >= 0; }
  std::size_t localOf(int node) const { return static_cast<std::size_t>(local_[static_cast<std::size_t>(node)]); }

  std::vector<int> local_;    // of each node: its row in the matrix, or -1
  std::vector<int> numbers_;  // of the nodes in the matrix
  BlockCholesky matrix_;
};

}  // namespace hl
