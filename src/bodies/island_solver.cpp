#include "bodies/island_solver.h"

#include <algorithm>
#include <limits>

namespace hl {

namespace {

// Sweeps before and after each direct solve; and after the last, where they still do not end.
constexpr int kFewSweeps = 3, kLastSweeps = 20;
constexpr int kDirectSolves = 5;
// Of single rows in a step, all sweeps of all solves; an island whose turn comes later has one direct solve, with
// kFewSweeps before and after it. Of these kSmallUpdates in the last sweeps of an island: one hand that presses a body
// against a wall is solved to the last digits.
constexpr int kMostUpdates = 10'000;
constexpr int kSmallUpdates = 4'000;

void restore(int number, std::span<Node> nodes, std::span<const Node> unpushed) {
  if (number == Row::kFixed) return;
  const auto i = static_cast<std::size_t>(number);
  nodes[i].velocity = unpushed[i].velocity;
  nodes[i].spin = unpushed[i].spin;
}

// Impulses that were not found to the end may push what is apart already, and add energy. Their work is s a + s^2 b / 2
// if each is multiplied by s, from 0 to 1; no more of them is kept than takes most, beside what impacts give back.
// `unpushed`: the nodes without any impulse. The search may have gone through impulses so large that taking them off
// again would leave what they were rounded by.
void keepPassive(std::span<Row> rows, std::span<Node> nodes, std::span<const Node> unpushed) {
  double after_J = 0, before_J = 0, given_back_J = 0;
  for (const Row& row : rows) {
    after_J += impulseOf(row).dot(relativeVelocity(row, nodes));
    given_back_J += row.pressed * std::max(0.0, row.least_velocity);
  }
  for (const Row& row : rows) {
    restore(row.a, nodes, unpushed);
    restore(row.b, nodes, unpushed);
  }
  for (const Row& row : rows) before_J += impulseOf(row).dot(relativeVelocity(row, nodes));
  const bool takes = (before_J + after_J) / 2 <= given_back_J;
  const double part = takes ? 1 : std::clamp((given_back_J - before_J) / (after_J - before_J), 0.0, 1.0);
  for (Row& row : rows) {
    row.pressed *= part;
    row.dragged *= part;
    applyImpulse(row, nodes, impulseOf(row));
  }
}

bool isNew(const Row& row) { return row.solved == Row::Solved::kNo; }
bool isSolved(const Row& row) { return row.solved == Row::Solved::kWhole; }

}  // namespace

IslandSolver::IslandSolver(const BodyProblem& problem)
    : islands_(problem.nodes.capacity()), sweeps_(problem.nodes.capacity()), direct_(problem.nodes.capacity()) {
  row_room_.reserve(problem.rows.capacity());
  joints_.reserve(problem.joints.blocks.size());
  joint_room_.reserve(problem.joints.blocks.size());
}

void IslandSolver::begin() { updates_left_ = kMostUpdates; }

bool IslandSolver::solveContacts(std::span<Row> rows, BodyProblem& problem, int& sweeps) {
  const bool converged = findContacts(rows, problem.nodes, problem.period_s, sweeps);
  if (!converged) keepPassive(rows, problem.nodes, problem.unpushed);
  return converged;
}

bool IslandSolver::findContacts(std::span<Row> rows, std::span<Node> nodes, double period_s, int& sweeps) {
  const int count = static_cast<int>(rows.size());
  double last_change = std::numeric_limits<double>::infinity();
  for (int time = 0;; ++time) {
    const RowSolver::Report report = sweep(rows, nodes, period_s, kFewSweeps, sweeps);
    if (report.converged) return true;
    if (updates_left_ <= 0 && time > 0) return false;
    // A direct solve that did not help began with other contacts than those of the solution, and so would the next.
    if (time == kDirectSolves || report.change > last_change) break;
    last_change = report.change;
    direct_.solve(rows, nodes, period_s);
  }
  const int most = std::max(kLastSweeps, kSmallUpdates / count);
  return sweep(rows, nodes, period_s, std::clamp(updates_left_ / count, kFewSweeps, most), sweeps).converged;
}

RowSolver::Report IslandSolver::sweep(std::span<Row> rows, std::span<Node> nodes, double period_s, int most,
                                      int& sweeps) {
  RowSolverLimits limits;
  limits.sweeps = most;
  const RowSolver::Report report = sweeps_.solve(rows, {}, nodes, period_s, limits);
  sweeps += report.sweeps;
  updates_left_ -= report.sweeps * static_cast<int>(rows.size());
  return report;
}

bool IslandSolver::solveJoined(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s,
                               int& sweeps) {
  const RowSolver::Report report =
      sweeps_.solve(rows, joints, nodes, period_s, limitsFor(rows.size() + joints.set->work(joints.numbers)));
  sweeps = report.sweeps;
  return report.converged;
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
    if (joints.numbers.empty() && std::none_of(rows.begin(), rows.end(), isNew)) {
      converged &= std::all_of(rows.begin(), rows.end(), isSolved);
      continue;
    }
    int made = 0;
    const bool whole = joints.numbers.empty() ? solveContacts(rows, problem, made)
                                              : solveJoined(rows, joints, problem.nodes, problem.period_s, made);
    for (Row& row : rows) row.solved = whole ? Row::Solved::kWhole : Row::Solved::kInPart;
    converged &= whole;
    sweeps = std::max(sweeps, made);
  }
  return converged;
}

}  // namespace hl
