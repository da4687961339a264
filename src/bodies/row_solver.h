// Row solver: the impulses of all contacts and joints of a step at once, by projected Gauss-Seidel: row after row, each
// as if the others were known, until nothing changes. The friction impulse is projected onto the disc of Coulomb's
// cone, with a step along the slip and not by components: where it rests, it opposes the slip exactly.
//
// The changes of a sweep are taken as a gradient for the nonlinear method of conjugate gradients (M. Silcowitz-Hansen,
// S. Niebe, K. Erleben, A nonsmooth nonlinear conjugate gradient method for interactive contact force problems, The
// Visual Computer 26, 2010): blocks in a row or a stack need tens of sweeps in place of thousands.
#pragma once

#include <cstddef>
#include <span>

#include "bodies/joint_set.h"
#include "bodies/row.h"

namespace hl {

struct RowSolverLimits {
  int sweeps = 60;
  double done = 1e-11;  ///< largest change of an impulse in a sweep over the largest impulse
};
/// By which the work of a step is bounded.
RowSolverLimits limitsFor(std::size_t rows);

/// Sets the steps of the row and applies the impulses with which it begins. RT-safe.
void prepareRow(Row& row, std::span<Node> nodes);
/// Of contacts and joints at once. Returns the sweeps made. `period_s` > 0. RT-safe.
int solveRows(std::span<Row> rows, const JointPart& joints, std::span<Node> nodes, double period_s,
              const RowSolverLimits& limits);
/// m/s: the least velocity along the normal that the row allows. RT-safe.
double demandOf(const Row& row, double period_s);
/// Velocity at the row's point, a's relative to b's. RT-safe.
Vec3 relativeVelocity(const Row& row, std::span<const Node> nodes);
/// Applies an impulse on a, and its opposite on b. RT-safe.
void applyImpulse(const Row& row, std::span<Node> nodes, const Vec3& impulse);

}  // namespace hl
