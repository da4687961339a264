#include "bodies/island_solver.h"

#include <algorithm>

namespace hl {

namespace {

// Sweeps before and after each direct solve.
constexpr int kFewSweeps = 6;
constexpr int kDirectSolves = 3;

}  // namespace

bool IslandSolver::solveOne(std::span<Row> rows, std::span<Node> nodes, double period_s, int most, int& sweeps) {
  RowSolverLimits limits;
  limits.sweeps = kFewSweeps;
  for (int time = 0; time <= kDirectSolves; ++time) {
    const int made = solveRows(rows, nodes, period_s, limits);
    sweeps += made;
    if (made < limits.sweeps) return true;
    if (time == kDirectSolves || !direct_.solve(rows, nodes, period_s)) break;
  }
  limits.sweeps = std::max(most - sweeps, kFewSweeps);
  const int made = solveRows(rows, nodes, period_s, limits);
  sweeps += made;
  return made < limits.sweeps;
}

bool IslandSolver::solve(std::vector<Row>& rows, std::span<Node> nodes, double period_s, int& sweeps) {
  islands_.gather(rows, nodes.size());
  const int most = limitsFor(rows.size()).sweeps;
  bool converged = true;
  for (std::size_t begin = 0; begin < rows.size();) {
    const std::size_t end = islands_.endOf(rows, begin);
    int made = 0;
    converged &= solveOne(std::span(rows).subspan(begin, end - begin), nodes, period_s, most, made);
    sweeps = std::max(sweeps, made);
    begin = end;
  }
  return converged;
}

}  // namespace hl
