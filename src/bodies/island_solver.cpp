#include "bodies/island_solver.h"

#include <algorithm>

namespace hl {

namespace {

// Sweeps before and after each direct solve; and after the last, where they still do not end.
constexpr int kFewSweeps = 6, kLastSweeps = 20;
constexpr int kDirectSolves = 3;
// Of single rows in a step, all sweeps of all solves; an island whose turn comes later has kFewSweeps. Small islands
// may take longer: one hand that presses a body against a wall is solved to the last digits.
constexpr int kMostUpdates = 20'000;
constexpr int kSmallUpdates = 4'000;

}  // namespace

void IslandSolver::begin() { updates_left_ = kMostUpdates; }

bool IslandSolver::solveOne(std::span<Row> rows, std::span<Node> nodes, double period_s, int& sweeps) {
  const int count = static_cast<int>(rows.size());
  RowSolverLimits limits;
  bool converged = false;
  for (int time = 0; !converged; ++time) {
    const bool last = time == kDirectSolves || (time > 0 && updates_left_ <= 0);
    limits.sweeps = updates_left_ <= 0 ? kFewSweeps : last ? std::max(kLastSweeps, kSmallUpdates / count) : kFewSweeps;
    const int made = solveRows(rows, nodes, period_s, limits);
    sweeps += made;
    updates_left_ -= made * count;
    converged = made < limits.sweeps;
    if (last) break;
    if (!converged) direct_.solve(rows, nodes, period_s);
  }
  return converged;
}

bool IslandSolver::solve(std::vector<Row>& rows, std::span<Node> nodes, double period_s, int& sweeps) {
  islands_.gather(rows, nodes.size());
  bool converged = true;
  for (std::size_t begin = 0; begin < rows.size();) {
    const std::size_t end = islands_.endOf(rows, begin);
    int made = 0;
    converged &= solveOne(std::span(rows).subspan(begin, end - begin), nodes, period_s, made);
    sweeps = std::max(sweeps, made);
    begin = end;
  }
  return converged;
}

}  // namespace hl
