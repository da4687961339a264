#include "bodies/joint_set.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace hl {

namespace {

std::vector<JointBlock> blocksOf(const World& world) {
  std::vector<JointBlock> blocks(world.joints.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].joint = &world.joints[i];
    blocks[i].a = nodeOf(world, world.joints[i].body_a);
    blocks[i].b = nodeOf(world, world.joints[i].body_b);
  }
  return blocks;
}

// Of the mobility of its two bodies alone, a coordinate has at least this part, and a loop gives way by it, though
// other joints may hold them still.
constexpr double kMinMobility = 1e-3, kSoft = 1e-4;

}  // namespace

JointSet::JointSet(const World& world) : blocks(blocksOf(world)), trees(world, blocks) {}

double JointSet::mobilityAlong(const JointBlock& block, std::span<const Node> nodes) {
  const JointAxis& axis = block.coordinate.axis;
  const double alone = mobilityBetween(axis, axis, block, nodes);
  return std::max(velocityAlong(axis, block, trees.afterImpulse(axis, block, blocks, nodes)), kMinMobility * alone);
}

void JointSet::prepareLoop(JointBlock& block, std::span<const Node> nodes) {
  Mat6 mobility = Mat6::Identity();
  for (std::size_t i = 0; i < block.size; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    mobility.col(row) = heldVelocities(block, trees.afterImpulse(block.rows[i], block, blocks, nodes));
    block.softness[row] = kSoft * mobilityBetween(block.rows[i], block.rows[i], block, nodes);
    mobility(row, row) += block.softness[row];
  }
  block.effective_mass = Eigen::LDLT<Mat6>(mobility).solve(Mat6::Identity());
}

std::size_t JointSet::work(std::span<const std::uint32_t> numbers) const {
  std::size_t links = numbers.size();
  for (const std::uint32_t number : numbers) {
    const JointBlock& block = blocks[number];
    links += ((block.closesLoop() ? 1 : 0) + (block.coordinate.there ? 1 : 0)) * trees.linksNear(block);
  }
  return 2 * links;
}

// After each row outside a tree its trees answer, so that it is solved as if they were rigid.
void JointSet::sweep(std::span<const std::uint32_t> numbers, std::span<Node> nodes, double period_s) {
  for (const std::uint32_t number : numbers) blocks[number].change.setZero();
  trees.solve(numbers, blocks, nodes);
  for (const std::uint32_t number : numbers) {
    JointBlock& block = blocks[number];
    if (block.closesLoop()) {
      solveHeld(block, nodes);
      trees.solveNear(block, blocks, nodes);
    }
    if (block.coordinate.there) {
      solveCoordinate(block, nodes, period_s);
      trees.solveNear(block, blocks, nodes);
    }
  }
}

void JointSet::searchOn(std::span<const std::uint32_t> numbers, std::span<Node> nodes, double part, bool anew) {
  for (const std::uint32_t number : numbers) searchJointOn(blocks[number], nodes, part, anew);
}

void JointSet::copyFrom(const JointSet& other, std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers) blocks[number] = other.blocks[number];
  trees.copyFrom(other.trees, blocks, numbers);
}

}  // namespace hl
