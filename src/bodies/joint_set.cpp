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

JointSet::JointSet(const World& world) : blocks(blocksOf(world)), tree(world, blocks) {}

void JointSet::prepare(std::span<Node> nodes) {
  tree.prepare(blocks, nodes);
  for (JointBlock& block : blocks) prepareJoint(block, nodes);
}

void JointSet::sweep(std::span<Node> nodes, double period_s) {
  for (JointBlock& block : blocks) solveCoordinate(block, nodes, period_s);
  for (JointBlock& block : blocks) {
    if (!block.in_tree && block.size > 0) solveHeld(block, nodes);
  }
  tree.solve(blocks, nodes);
}

void JointSet::searchOn(std::span<Node> nodes, double part, bool anew) {
  for (JointBlock& block : blocks) searchJointOn(block, nodes, part, anew);
}

}  // namespace hl
