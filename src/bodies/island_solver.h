// Island solver: the impulses of all rows and joints of a step, island by island: roughly by a few sweeps, or exactly:
// where these do not end, by Newton's method and sweeps in turn. An island with joints has sweeps alone, in which the
// trees of its joints are solved at once (joint_tree.h).
#pragma once

#include "bodies/body_problem.h"
#include "bodies/islands.h"
#include "bodies/newton_solve.h"
#include "bodies/row_solver.h"
#include "bodies/step_work.h"

namespace hl {

/// By one thread at a time.
class IslandSolver {
 public:
  explicit IslandSolver(const BodyProblem& problem);

  /// Of prepared rows, whose order it changes, and joints. What is hard takes up to half of the work that is left, one
  /// island after another; which is first changes from step to step. `sweeps`: of the island that took the most.
  /// False: one ended at its limit of work. RT-safe.
  bool solve(BodyProblem& problem, Accuracy accuracy, StepWork& work, int& sweeps);

 private:
  struct Part {
    std::span<Row> rows;
    JointPart joints;
  };

  void gather(BodyProblem& problem);
  bool hasNext(const BodyProblem& problem) const;
  Part next(BodyProblem& problem);
  std::span<Row> takeRows(BodyProblem& problem, int island);
  std::span<const std::uint32_t> takeJoints(const BodyProblem& problem, int island);
  Row::Solved begin(const Part& part, BodyProblem& problem, Accuracy accuracy, StepWork& work, int& sweeps);
  Row::Solved beginJoined(const Part& part, BodyProblem& problem, StepWork& work, int& sweeps);
  bool finish(std::span<Row> rows, BodyProblem& problem, StepWork& work, int& sweeps);
  bool findContacts(std::span<Row> rows, BodyProblem& problem, int& work, int& sweeps);
  bool goByNewton(std::span<Row> rows, BodyProblem& problem, int& work);

  Islands islands_;
  RowSolver sweeps_;
  NewtonSolve newton_;
  std::vector<std::span<Row>> unsolved_;  // islands
  std::vector<Row> row_room_;
  std::vector<std::uint32_t> joints_, joint_room_;  // numbers of those that are stepped, by island
  std::size_t next_row_ = 0, next_joint_ = 0;
};

}  // namespace hl
