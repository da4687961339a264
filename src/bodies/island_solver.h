// Island solver: the impulses of all rows and joints of a step, island by island: a few sweeps, and where they do not
// end, the direct solve and sweeps in turn. An island with joints has sweeps alone, in which the trees of its joints
// are solved at once (joint_tree.h).
#pragma once

#include "bodies/body_problem.h"
#include "bodies/direct_solve.h"
#include "bodies/islands.h"
#include "bodies/row_solver.h"

namespace hl {

/// By one thread at a time.
class IslandSolver {
 public:
  explicit IslandSolver(const BodyProblem& problem);

  /// Of a step, before its first solve(). RT-safe.
  void begin();
  /// Of prepared rows, whose order it changes, and joints. `sweeps`: of the island that took the most. False: one ended
  /// at its limit of work. RT-safe.
  bool solve(BodyProblem& problem, int& sweeps);

 private:
  void gather(BodyProblem& problem);
  std::span<Row> takeRows(BodyProblem& problem, int island);
  std::span<const std::uint32_t> takeJoints(const BodyProblem& problem, int island);
  bool findContacts(std::span<Row> rows, std::span<Node> nodes, double period_s, int& sweeps);
  bool solveContacts(std::span<Row> rows, BodyProblem& problem, int& sweeps);
  RowSolver::Report sweep(std::span<Row> rows, std::span<Node> nodes, double period_s, int most, int& sweeps);
  bool solveJoined(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s, int& sweeps);

  Islands islands_;
  RowSolver sweeps_;
  DirectSolve direct_;
  std::vector<Row> row_room_;
  std::vector<std::uint32_t> joints_, joint_room_;  // numbers of those that are stepped, by island
  std::size_t next_row_ = 0, next_joint_ = 0;
  int updates_left_ = 0;
};

}  // namespace hl
