// Newton solve: the impulses of an island whose contacts come apart, stick and slip, to the last digits in a few steps.
// Sweeps need tens to thousands of rounds to carry a load through a stack; but they find their way from anywhere.
//
// With the velocities v = v0 + M^-1 J' P of the bodies, and steps s of each row (kg), impulses P are a solution where
//
//   P = C(P + s (d - J v)),
//
// with C the projection onto Coulomb's cone of the row: its normal part to 0 or more, its part across the normal into
// the disc of friction times the normal part (P. Alart, A. Curnier, A mixed formulation for frictional contact problems
// prone to Newton like solution methods, Computer Methods in Applied Mechanics and Engineering 92, 1991). C has a
// derivative nearly everywhere: that of a row that is apart, sticks or slips. Each step of Newton's method solves
//
//   (M + J' D J) dv = J' P1 - M (v - v0),    P1 = the impulses that the rows ask for, D = -dP1/d(J v),
//
// and goes a part of dv with which the rows are nearer to a solution. What must not move has a weight in D much above
// the masses in place of an infinite one, and is asked for twice: a stool with four legs has more rows than it
// can move, so the matrix is that of the bodies, not that of the rows.
#pragma once

#include <span>
#include <vector>

#include "bodies/block_lu.h"
#include "bodies/contact_cone.h"

namespace hl {

/// By one thread at a time.
class NewtonSolve {
 public:
  NewtonSolve(std::size_t most_nodes, std::size_t most_rows);

  /// Of the rows of an island, prepared. False: the matrix of the island is too large. RT-safe.
  bool begin(std::span<const Row> rows, std::span<const Node> nodes);
  /// After begin(): what a step costs, in updates of a row by a sweep.
  int updatesOfStep() const { return updates_of_step_; }
  /// After begin(), with the same rows. False: there is no solution after so many steps; the rows then have the best
  /// impulses that were found. RT-safe.
  bool solve(std::span<Row> rows, std::span<Node> nodes, double period_s, int most_steps);
  /// Of the last solve().
  int steps() const { return steps_; }

 private:
  struct Velocity {
    Vec3 linear = Vec3::Zero(), spin = Vec3::Zero();
  };
  /// A body or a hand.
  struct Motion {
    int node = 0;
    double mass_kg = 0;
    Mat3 inertia = Mat3::Identity();  ///< kg m^2, world frame
    Velocity begun, last, change;     ///< before the solve, before the step, and by all of the step
  };
  struct Contact {
    double demand = 0;                                  ///< m/s, along the normal
    Vec3 missed = Vec3::Zero();                         ///< m/s: what is demanded less what is
    Vec3 begun = Vec3::Zero(), impulse = Vec3::Zero();  ///< N s: before the solve, and now
    Vec3 last = Vec3::Zero(), change = Vec3::Zero();    ///< N s: before the step, and by all of the step
    ConePlace place, best;                              ///< of the impulse, and of the nearest
  };
  /// How far the impulses are from a solution: the sum of the squares, over their steps, and the largest change that
  /// the projection makes over the largest impulse.
  struct Distance {
    double sum_J = 0, largest = 0;
  };

  bool moves(int node) const { return node != Row::kFixed && local_[static_cast<std::size_t>(node)] >= 0; }
  std::size_t localOf(int node) const { return static_cast<std::size_t>(local_[static_cast<std::size_t>(node)]); }
  void number(std::span<const Row> rows, std::span<const Node> nodes);
  void start(std::span<const Row> rows, std::span<const Node> nodes, double period_s);
  Distance look(std::span<const Row> rows, std::span<const Node> nodes);
  void keepBest(std::span<const Row> rows, const Distance& distance);
  bool assemble(std::span<const Row> rows);
  void addRow(const Row& row, const Mat3& stiffness);
  void push(const Row& row, const Vec3& impulse);
  void takeMomenta(std::span<const Node> nodes);
  Vec3 moved(const Row& row);
  void ask(std::span<const Row> rows, std::span<Node> nodes);
  void goWhole(std::span<const Row> rows, std::span<Node> nodes);
  Distance goPart(std::span<const Row> rows, std::span<Node> nodes, double part);
  Distance goOn(std::span<const Row> rows, std::span<Node> nodes, const Distance& from);
  void finish(std::span<Row> rows, std::span<Node> nodes);
  bool comeNear(std::span<Row> rows, std::span<Node> nodes, double period_s, int most_steps);

  std::vector<int> local_;  // of each node: its row in the matrix, or -1
  std::vector<Motion> motions_;
  std::vector<Contact> contacts_;
  BlockLu matrix_;
  Distance best_;
  int steps_ = 0, updates_of_step_ = 0;
};

}  // namespace hl
