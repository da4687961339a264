// Joint tree: the rows that hold of all joints at once. Where joints connect bodies as a tree, as arms, chains and
// doors do, their impulses follow in one pass from the leaves to the root and one back, of a work that grows with the
// number of joints (D. Baraff, Linear-time dynamics using Lagrange multipliers, SIGGRAPH 1996). Joint by joint, a chain
// of ten would need hundreds of sweeps. A joint that closes a loop is none of a tree.
#pragma once

#include <vector>

#include "bodies/joint_block.h"
#include "bodies/world.h"

namespace hl {

/// All trees of a world. By one thread at a time.
class JointTrees {
 public:
  /// `blocks`: as World::joints; says of each whether it is of a tree.
  JointTrees(const World& world, std::span<JointBlock> blocks);
  /// The trees of the blocks with these numbers, for the bodies and rows of this step. RT-safe, as all below.
  void prepare(std::span<const std::uint32_t> numbers, std::span<const JointBlock> blocks, std::span<const Node> nodes);
  /// As another has them, of the same world.
  void copyFrom(const JointTrees& other, std::span<const JointBlock> blocks, std::span<const std::uint32_t> numbers);
  /// Adds the impulses after which all joints of these trees have the velocities that they want.
  void solve(std::span<const std::uint32_t> numbers, std::span<JointBlock> blocks, std::span<Node> nodes);
  /// Of the trees of the two bodies of a block.
  void solveNear(const JointBlock& block, std::span<JointBlock> blocks, std::span<Node> nodes);
  /// In these trees.
  std::size_t linksNear(const JointBlock& block) const;
  /// The bodies of a block, at rest, after an impulse of 1 N s along the axis, while the trees hold.
  std::span<const Node> afterImpulse(const JointAxis& axis, const JointBlock& block, std::span<const JointBlock> blocks,
                                     std::span<const Node> nodes);

 private:
  /// A joint between a body and the one that is nearer to the root; Row::kFixed: the world is the root.
  struct Link {
    std::size_t block = 0;
    int child = 0, parent = Row::kFixed;
    Mat6 of_child = Mat6::Zero(), of_parent = Mat6::Zero();  ///< rows: velocity (m/s, rad/s) to that of a row
    Mat6 effective_mass = Mat6::Identity();                  ///< kg, of the child and what hangs on it
    Vec6 missing = Vec6::Zero();                             ///< m/s, what the rows lack
    Vec6 impulse = Vec6::Zero();                             ///< N s, that gives it
  };
  struct Tree {
    std::size_t begin = 0, end = 0;  ///< of its links, from the root to the leaves
    int root = Row::kFixed;          ///< a body, or the world
  };
  void grow(int root, std::size_t first, std::span<JointBlock> blocks);
  void follow(std::vector<int>& bodies, std::size_t next, std::span<JointBlock> blocks);
  void prepare(const Tree& tree, std::span<const JointBlock> blocks, std::span<const Node> nodes);
  void solve(const Tree& tree, std::span<JointBlock> blocks, std::span<Node> nodes);
  void answer(const Tree& tree);
  template <typename Do>
  void forTreesOf(const JointBlock& block, Do&& act) const;
  template <typename Do>
  void forTreesOf(std::span<const std::uint32_t> numbers, std::span<const JointBlock> blocks, Do&& act) const;

  std::vector<Link> links_;
  std::vector<Tree> trees_;
  std::vector<int> tree_of_;  // of each body; kNone
  // Of each body, with what hangs on it: the inverse of its mass (1/kg, ..), what joints ask of it (N s, N m s), and
  // its change of velocity and spin.
  std::vector<Mat6> mobility_;
  std::vector<Vec6> asked_, change_;
  std::vector<Node> trial_;
};

}  // namespace hl
