// Island solver: the impulses of all rows of a step, island by island: a few sweeps, and where they do not end, the
// direct solve and sweeps in turn.
#pragma once

#include "bodies/direct_solve.h"
#include "bodies/islands.h"
#include "bodies/row_solver.h"

namespace hl {

/// By one thread at a time.
class IslandSolver {
 public:
  IslandSolver(std::size_t most_nodes, std::size_t most_rows) : islands_(most_nodes, most_rows), direct_(most_nodes) {}

  /// Of a step, before its first solve(). RT-safe.
  void begin();
  /// Of prepared rows, whose order it changes. `sweeps`: of the island that took the most. False: one ended at its
  /// limit of work. RT-safe.
  bool solve(std::vector<Row>& rows, std::span<Node> nodes, double period_s, int& sweeps);

 private:
  bool solveOne(std::span<Row> rows, std::span<Node> nodes, double period_s, int& sweeps);

  Islands islands_;
  DirectSolve direct_;
  int updates_left_ = 0;
};

}  // namespace hl
