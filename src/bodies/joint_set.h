// Joint set: all joints of a step in the solve (row_solver.h).
#pragma once

#include <vector>

#include "bodies/joint_tree.h"

namespace hl {

/// By one thread at a time.
struct JointSet {
  explicit JointSet(const World& world);
  /// After each block is made: applies the impulses with which they begin. RT-safe, as all below.
  void prepare(std::span<Node> nodes);
  /// One sweep of the solver over all joints.
  void sweep(std::span<Node> nodes, double period_s);
  void searchOn(std::span<Node> nodes, double part, bool anew);

  std::vector<JointBlock> blocks;  ///< as World::joints
  JointTree tree;
};

}  // namespace hl
