#include "bodies/island_solver.h"

#include <algorithm>

namespace hl {

namespace {

// Sweeps of a rough solve, and the largest change of an impulse at its end over the largest impulse.
constexpr int kRoughSweeps = 5;
constexpr double kRoughlyDone = 1e-4;
// Of an exact one: how often Newton's method is tried, its steps, and the sweeps after it.
constexpr int kTries = 2, kNewtonSteps = 30, kSweeps = 20;
// Updates of such sweeps in any case: one hand that presses a body against a wall is solved to the last digits.
constexpr int kSmallUpdates = 1'000;
// Sweeps that an island may have in any case.
constexpr int kMinSweeps = 10;

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

// Whether something in the island has changed since it was solved so accurately.
bool needsSolve(std::span<const Row> rows, Accuracy accuracy) {
  const Row::Solved least = accuracy == Accuracy::kExact ? Row::Solved::kInPart : Row::Solved::kRoughly;
  return std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.solved < least; });
}

void mark(std::span<Row> rows, Row::Solved solved) {
  for (Row& row : rows) row.solved = solved;
}

bool isSolved(const Row& row) { return row.solved == Row::Solved::kWhole; }

}  // namespace

IslandSolver::IslandSolver(const BodyProblem& problem)
    : islands_(problem.nodes.capacity()),
      sweeps_(problem.nodes.capacity()),
      newton_(problem.nodes.capacity(), problem.rows.capacity()) {
  unsolved_.reserve(problem.nodes.capacity());
  row_room_.reserve(problem.rows.capacity());
  joints_.reserve(problem.joints.blocks.size());
  joint_room_.reserve(problem.joints.blocks.size());
}

// After newton_.begin(). False as well if it has no work left for a step.
bool IslandSolver::goByNewton(std::span<Row> rows, BodyProblem& problem, int& work) {
  const int most = std::min(work / newton_.updatesOfStep(), kNewtonSteps);
  const bool converged = newton_.solve(rows, problem.nodes, problem.period_s, most);
  work -= newton_.steps() * newton_.updatesOfStep();
  return converged;
}

bool IslandSolver::findContacts(std::span<Row> rows, BodyProblem& problem, int& work, int& sweeps) {
  const int count = static_cast<int>(rows.size());
  const bool fits = newton_.begin(rows, problem.nodes);
  for (int time = 0; time < kTries && work > 0; ++time) {
    if (fits && goByNewton(rows, problem, work)) return true;
    RowSolverLimits limits;
    limits.sweeps = std::clamp(work / count, 1, std::max(kSweeps, kSmallUpdates / count));
    const RowSolver::Report report = sweeps_.solve(rows, {}, problem.nodes, problem.period_s, limits);
    sweeps += report.sweeps;
    work -= report.sweeps * count;
    if (report.converged) return true;
  }
  return false;
}

bool IslandSolver::finish(std::span<Row> rows, BodyProblem& problem, StepWork& work, int& sweeps) {
  const int most = std::max(work.left() / 2, kMinSweeps * static_cast<int>(rows.size()));
  int left = most;
  const bool converged = findContacts(rows, problem, left, sweeps);
  if (!converged) keepPassive(rows, problem.nodes, problem.unpushed);
  work.spend(most - left);
  return converged;
}

Row::Solved IslandSolver::beginJoined(const Part& part, BodyProblem& problem, StepWork& work, int& sweeps) {
  const int of_sweep = static_cast<int>(part.rows.size() + part.joints.set->work(part.joints.numbers));
  RowSolverLimits limits;
  limits.sweeps = work.sweepsOf(of_sweep, kMinSweeps);
  const RowSolver::Report report = sweeps_.solve(part.rows, part.joints, problem.nodes, problem.period_s, limits);
  sweeps = report.sweeps;
  work.spend(sweeps * of_sweep);
  return report.converged ? Row::Solved::kWhole : Row::Solved::kInPart;
}

// Most islands are solved by the first sweep: they lie as they lay.
Row::Solved IslandSolver::begin(const Part& part, BodyProblem& problem, Accuracy accuracy, StepWork& work,
                                int& sweeps) {
  if (accuracy == Accuracy::kExact && !part.joints.numbers.empty()) return beginJoined(part, problem, work, sweeps);
  RowSolverLimits limits;
  limits.sweeps = accuracy == Accuracy::kRough ? kRoughSweeps : 1;
  if (accuracy == Accuracy::kRough) limits.done = kRoughlyDone;
  const RowSolver::Report report = sweeps_.solve(part.rows, part.joints, problem.nodes, problem.period_s, limits);
  sweeps = report.sweeps;
  work.spend(report.sweeps * static_cast<int>(part.rows.size()));
  if (accuracy == Accuracy::kRough) return Row::Solved::kRoughly;
  return report.converged ? Row::Solved::kWhole : Row::Solved::kNo;
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

bool IslandSolver::hasNext(const BodyProblem& problem) const {
  return next_row_ < problem.rows.size() || next_joint_ < joints_.size();
}

IslandSolver::Part IslandSolver::next(BodyProblem& problem) {
  int island = static_cast<int>(problem.nodes.size());
  if (next_row_ < problem.rows.size()) island = islands_.of(problem.rows[next_row_].a);
  if (next_joint_ < joints_.size())
    island = std::min(island, islands_.of(problem.joints.blocks[joints_[next_joint_]].a));
  const std::span<Row> rows = takeRows(problem, island);
  return {rows, {&problem.joints, takeJoints(problem, island)}};
}

// Which hard island is first, and so may have the most work, changes from step to step: after a while each has been
// solved, and what is solved is easy in the next step.
bool IslandSolver::solve(BodyProblem& problem, Accuracy accuracy, StepWork& work, int& sweeps) {
  gather(problem);
  unsolved_.clear();
  bool converged = true;
  while (hasNext(problem)) {
    const Part part = next(problem);
    if (part.joints.numbers.empty() && !needsSolve(part.rows, accuracy)) {
      converged &= std::all_of(part.rows.begin(), part.rows.end(), isSolved);
      continue;
    }
    int made = 0;
    const Row::Solved solved = begin(part, problem, accuracy, work, made);
    mark(part.rows, solved);
    if (solved == Row::Solved::kNo) unsolved_.push_back(part.rows);
    converged &= solved == Row::Solved::kNo || solved == Row::Solved::kWhole;
    sweeps = std::max(sweeps, made);
  }
  for (std::size_t i = 0; i < unsolved_.size(); ++i) {
    const std::span<Row> rows = unsolved_[(problem.step + i) % unsolved_.size()];
    int made = 0;
    const bool whole = finish(rows, problem, work, made);
    mark(rows, whole ? Row::Solved::kWhole : Row::Solved::kInPart);
    converged &= whole;
    sweeps = std::max(sweeps, made);
  }
  return converged;
}

}  // namespace hl
