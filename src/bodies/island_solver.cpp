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

IslandSolver::IslandSolver(const BodyProblem& problem)
    : islands_(problem.nodes.capacity()), direct_(problem.nodes.capacity()) {
  row_room_.reserve(problem.rows.capacity());
  joints_.reserve(problem.joints.blocks.size());
  joint_room_.reserve(problem.joints.blocks.size());
}

void IslandSolver::begin() { updates_left_ = kMostUpdates; }

bool IslandSolver::solveContacts(std::span<Row> rows, std::span<Node> nodes, double period_s, int& sweeps) {
  const int count = static_cast<int>(rows.size());
  RowSolverLimits limits;
  bool converged = false;
  for (int time = 0; !converged; ++time) {
    const bool last = time == kDirectSolves || (time > 0 && updates_left_ <= 0);
    limits.sweeps = updates_left_ <= 0 ? kFewSweeps : last ? std::max(kLastSweeps, kSmallUpdates / count) : kFewSweeps;
    const int made = solveRows(rows, {}, nodes, period_s, limits);
    sweeps += made;
    updates_left_ -= made * count;
    converged = made < limits.sweeps;
    if (last) break;
    if (!converged) direct_.solve(rows, nodes, period_s);
  }
  return converged;
}

bool IslandSolver::solveJoined(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s,
                               int& sweeps) {
  const RowSolverLimits limits = limitsFor(rows.size() + joints.set->work(joints.numbers));
  sweeps = solveRows(rows, joints, nodes, period_s, limits);
  return sweeps < limits.sweeps;
}

void IslandSolver::gather(BodyProblem& problem) {
  const std::vector<JointBlock>& blocks = problem.joints.blocks;
  islands_.begin(problem.nodes.size());
  for (const Row& row : problem.rows) {
    if (row.b != Row::kFixed) islands_.join(row.a, row.b);
  }
  for (const std::uint32_t joint : problem.awake_joints) {
    if (blocks[joint].b != Row::kFixed) islands_.join(blocks[joint].a, blocks[joint].b);
  }
  joints_ = problem.awake_joints;
  islands_.gather(problem.rows, row_room_, [](const Row& row) { return row.a; });
  islands_.gather(joints_, joint_room_, [&](std::uint32_t joint) { return blocks[joint].a; });
  next_row_ = next_joint_ = 0;
}

std::span<Row> IslandSolver::takeRows(BodyProblem& problem, int island) {
  const std::size_t begin = next_row_;
  while (next_row_ < problem.rows.size() && islands_.of(problem.rows[next_row_].a) == island) ++next_row_;
  return std::span(problem.rows).subspan(begin, next_row_ - begin);
}

std::span<const std::uint32_t> IslandSolver::takeJoints(const BodyProblem& problem, int island) {
  const std::size_t begin = next_joint_;
  while (next_joint_ < joints_.size() && islands_.of(problem.joints.blocks[joints_[next_joint_]].a) == island)
    ++next_joint_;
  return std::span(joints_).subspan(begin, next_joint_ - begin);
}

bool IslandSolver::solve(BodyProblem& problem, int& sweeps) {
  gather(problem);
  bool converged = true;
  while (next_row_ < problem.rows.size() || next_joint_ < joints_.size()) {
    int island = static_cast<int>(problem.nodes.size());
    if (next_row_ < problem.rows.size()) island = islands_.of(problem.rows[next_row_].a);
    if (next_joint_ < joints_.size())
      island = std::min(island, islands_.of(problem.joints.blocks[joints_[next_joint_]].a));
    const std::span<Row> rows = takeRows(problem, island);
    const JointPart joints{&problem.joints, takeJoints(problem, island)};
    int made = 0;
    converged &= joints.numbers.empty() ? solveContacts(rows, problem.nodes, problem.period_s, made)
                                        : solveJoined(rows, joints, problem.nodes, problem.period_s, made);
    sweeps = std::max(sweeps, made);
  }
  return converged;
}

}  // namespace hl
