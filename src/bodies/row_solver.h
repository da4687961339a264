// Row solver: the impulses of all contacts and joints of a step at once, by projected Gauss-Seidel: row after row, each
// as if the others were known, until nothing changes. The friction impulse is projected onto the disc of Coulomb's
// cone, with a step along the slip and not by components: where it rests, it opposes the slip exactly.
//
// The changes of a sweep are taken as a gradient for the nonlinear method of conjugate gradients (M. Silcowitz-Hansen,
// S. Niebe, K. Erleben, A nonsmooth nonlinear conjugate gradient method for interactive contact force problems, The
// Visual Computer 26, 2010): blocks in a row or a stack need tens of sweeps in place of thousands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bodies/joint_set.h"
#include "bodies/row.h"

namespace hl {

struct RowSolverLimits {
  int sweeps = 60;
  double done = 1e-11;  ///< largest change of an impulse in a sweep over the largest impulse
};

/// Sets the steps of the row and applies the impulses with which it begins. RT-safe.
void prepareRow(Row& row, std::span<Node> nodes);

/// By one thread at a time.
class RowSolver {
 public:
  explicit RowSolver(std::size_t most_nodes);
  /// How often it went over the rows, and the largest change of an impulse in the last sweep over the largest impulse.
  struct Report {
    int sweeps = 0;
    double change = 0;
    bool converged = false;
  };
  /// Of contacts and joints at once, of prepared rows. `period_s` > 0. RT-safe.
  Report solve(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s,
               const RowSolverLimits& limits);

 private:
  /// What the impulses of the rows do to a node: m/s and rad/s.
  struct Motion {
    int node = 0;
    Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();                ///< before the sweep
    Vec3 search_velocity = Vec3::Zero(), search_spin = Vec3::Zero();  ///< along the direction of the search
  };
  /// The largest change of an impulse in a sweep, the sum of all, and the largest impulse: squares of N s.
  struct Swept {
    double changed = 0, sum = 0, largest = 0;
  };
  void begin(std::span<Row> rows, std::span<const Node> nodes, double period_s);
  void add(int node, std::span<const Node> nodes);
  void sweepJoints(const JointPart& joints, std::span<Node> nodes, double period_s, Swept& swept);
  void sweepRows(std::span<Row> rows, std::span<Node> nodes, double part, Swept& swept);
  void searchOn(std::span<Node> nodes, double part);

  std::vector<Motion> motions_;       // of the nodes of these rows
  std::vector<std::uint8_t> is_met_;  // of each node: it is in the list
};

}  // namespace hl
