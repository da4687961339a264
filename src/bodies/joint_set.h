// Joint set: all joints of a step in the solve (row_solver.h).
#pragma once

#include <vector>

#include "bodies/joint_tree.h"

namespace hl {

/// By one thread at a time.
struct JointSet {
  explicit JointSet(const World& world);
  /// One sweep of the solver over all joints. RT-safe, as all below.
  void sweep(std::span<Node> nodes, double period_s);
  void searchOn(std::span<Node> nodes, double part, bool anew);

  std::vector<JointBlock> blocks;  ///< as World::joints
  JointTrees trees;
};

}  // namespace hl
