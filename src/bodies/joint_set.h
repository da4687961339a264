// Joint set: all joints of a step in the solve (row_solver.h).
#pragma once

#include <vector>

#include "bodies/joint_tree.h"

namespace hl {

/// By one thread at a time.
struct JointSet {
  explicit JointSet(const World& world);
  /// 1/kg: of a coordinate while the trees, which are prepared, hold. RT-safe, as all below.
  double mobilityAlong(const JointBlock& block, std::span<const Node> nodes);
  /// The masses of a block that closes a loop.
  void prepareLoop(JointBlock& block, std::span<const Node> nodes);
  /// Of a sweep, in updates of single rows.
  std::size_t work() const;
  /// One sweep of the solver over all joints.
  void sweep(std::span<Node> nodes, double period_s);
  void searchOn(std::span<Node> nodes, double part, bool anew);

  std::vector<JointBlock> blocks;  ///< as World::joints
  JointTrees trees;
};

}  // namespace hl
