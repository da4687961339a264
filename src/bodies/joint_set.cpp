#include "bodies/joint_set.h"

namespace hl {

namespace {

std::vector<JointBlock> blocksOf(const World& world) {
  const auto number = [&](std::uint64_t key) {
    const Body* const body = world.find(key);
    return body == nullptr ? Row::kFixed : static_cast<int>(body - world.bodies.data());
  };
  std::vector<JointBlock> blocks(world.joints.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].joint = &world.joints[i];
    blocks[i].a = number(world.joints[i].body_a);
    blocks[i].b = number(world.joints[i].body_b);
  }
  return blocks;
}

}  // namespace

JointSet::JointSet(const World& world) : blocks(blocksOf(world)), trees(world, blocks) {}

// After each row outside a tree its trees answer, so that it is solved as if they were rigid.
void JointSet::sweep(std::span<Node> nodes, double period_s) {
  for (JointBlock& block : blocks) block.change.setZero();
  trees.solve(blocks, nodes);
  for (JointBlock& block : blocks) {
    const bool closes_loop = !block.in_tree && block.size > 0;
    if (closes_loop) solveHeld(block, nodes);
    if (block.coordinate.there) solveCoordinate(block, nodes, period_s);
    if (closes_loop || block.coordinate.there) trees.solveNear(block, blocks, nodes);
  }
}

void JointSet::searchOn(std::span<Node> nodes, double part, bool anew) {
  for (JointBlock& block : blocks) searchJointOn(block, nodes, part, anew);
}

}  // namespace hl
