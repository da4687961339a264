// Joint block: what a joint is in the solve of a step: up to six rows that hold, solved at once, and one row along its
// coordinate. The impulses of both act on nodes as those of contacts do (row.h).
#pragma once

#include <span>

#include "bodies/joint_place.h"
#include "bodies/row.h"

namespace hl {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Along the coordinate; `N s` and `kg` stand for N m s and kg m^2 if it is an angle.
struct CoordinateRow {
  /// Impulses, N s: of spring, damper and table; of dry friction; of limits.
  enum Cause { kDriven, kRubbed, kStopped };
  bool there = false;
  JointAxis axis;
  double mobility = 0;  ///< 1/kg
  double lever_m = 1;   ///< of an angle; compares its impulses with others
  // Spring and damper: driven = pull - mass v, v the velocity after the step.
  double pull = 0, mass = 0;                          ///< N s, kg
  const ForceTable* table = nullptr;                  ///< null: none
  double from = 0;                                    ///< the coordinate at the begin of the step
  double most_rubbed = 0;                             ///< N s
  double least = 0, most = 0;                         ///< m/s, of v: what limits leave
  Vec3 impulses = Vec3::Zero();                       ///< by Cause
  Vec3 change = Vec3::Zero(), search = Vec3::Zero();  ///< of the solver
};

struct JointBlock {
  static constexpr int kNone = -1;
  const Joint* joint = nullptr;
  int a = 0, b = Row::kFixed;  ///< numbers of nodes
  double lever_m = 1;          ///< one rad counts as this way: the bodies' radius of gyration, so that rows compare
  int begins_tree = kNone;     ///< number of the tree whose first link it is
  bool in_tree = false;        ///< joint_tree.h solves its rows that hold; else they close a loop
  std::size_t size = 0;        ///< of the rows that hold
  std::array<JointAxis, 6> rows;
  // Of a block that closes a loop, 1/kg and kg. It gives way by `softness` per impulse: of what it holds, the tree may
  // hold a part already.
  Vec6 softness = Vec6::Zero();
  Mat6 effective_mass = Mat6::Identity();
  Vec6 wanted = Vec6::Zero();                         ///< m/s
  Vec6 held = Vec6::Zero();                           ///< N s, on a
  Vec6 change = Vec6::Zero(), search = Vec6::Zero();  ///< N s, of the solver, in this sweep
  CoordinateRow coordinate;
  double least_change = 0;  ///< N s: below it is rounding

  bool closesLoop() const { return !in_tree && size > 0; }
};

/// What a sweep did to a block, squares of N s.
struct BlockSweep {
  double change = 0, largest = 0;
};

/// m/s. RT-safe, as all below.
double velocityAlong(const JointAxis& axis, const JointBlock& block, std::span<const Node> nodes);
void pushAlong(const JointAxis& axis, const JointBlock& block, std::span<Node> nodes, double impulse_N_s);
/// 1/kg: what an impulse along `row` does to the velocity along `of`.
double mobilityBetween(const JointAxis& of, const JointAxis& row, const JointBlock& block, std::span<const Node> nodes);
/// m/s: of the rows that hold.
Vec6 heldVelocities(const JointBlock& block, std::span<const Node> nodes);
void pushHeld(const JointBlock& block, std::span<Node> nodes, const Vec6& impulses);
/// Pushes, and adds the impulses to those that hold and to the change of the sweep.
void addHeld(JointBlock& block, std::span<Node> nodes, const Vec6& impulses);
/// Applies the impulses with which the block begins.
void prepareJoint(JointBlock& block, std::span<Node> nodes);
/// The rows that hold, as if all else were known.
void solveHeld(JointBlock& block, std::span<Node> nodes);
void solveCoordinate(JointBlock& block, std::span<Node> nodes, double period_s);
/// After both.
BlockSweep sweepOf(const JointBlock& block);
/// As searchOn() of the row solver: along the last direction by `part` of it, or anew.
void searchJointOn(JointBlock& block, std::span<Node> nodes, double part, bool anew);

}  // namespace hl
