// Joint tree: the rows that hold of all joints at once. Where joints connect bodies as a tree, as arms, chains and
// doors do, their impulses follow in one pass from the leaves to the roots and one back, of a work that grows with the
// number of joints (D. Baraff, Linear-time dynamics using Lagrange multipliers, SIGGRAPH 1996). Joint by joint, a chain
// of ten would need hundreds of sweeps. A joint that closes a loop is none of the tree.
#pragma once

#include <vector>

#include "bodies/joint_block.h"
#include "bodies/world.h"

namespace hl {

/// By one thread at a time.
class JointTree {
 public:
  /// `blocks`: as World::joints; says of each whether it is of the tree.
  JointTree(const World& world, std::span<JointBlock> blocks);
  /// For the bodies and rows of this step. RT-safe, as all below.
  void prepare(std::span<const JointBlock> blocks, std::span<const Node> nodes);
  /// The impulses after which all joints of the tree have the velocities that they want, and their change.
  void solve(std::span<JointBlock> blocks, std::span<Node> nodes);

 private:
  /// A joint between a body and the one that is nearer to the root; Row::kFixed: the world is the root.
  struct Link {
    std::size_t block = 0;
    int child = 0, parent = Row::kFixed;
    Mat6 of_child = Mat6::Zero(), of_parent = Mat6::Zero();  ///< rows: velocity (m/s, rad/s) to that of a row
    Mat6 effective_mass = Mat6::Identity();                  ///< kg, of the child and what hangs on it
    Vec6 asked = Vec6::Zero();                               ///< N s, where the parent stays
  };
  void grow(std::vector<int> bodies, std::span<JointBlock> blocks, std::vector<bool>& reached);

  std::vector<Link> links_;  // from the roots to the leaves
  std::vector<int> roots_;   // bodies that no joint holds to a parent
  // Of each body, with what hangs on it: the inverse of its mass (1/kg, ..), what joints ask of it (N s, N m s), and
  // its change of velocity and spin.
  std::vector<Mat6> mobility_;
  std::vector<Vec6> asked_, change_;
};

}  // namespace hl
