#include "bodies/joint_tree.h"

#include <Eigen/Cholesky>

namespace hl {

namespace {

Mat6 inverseOf(const Mat6& definite) { return Eigen::LDLT<Mat6>(definite).solve(Mat6::Identity()); }

Mat6 massOf(const Node& node) {
  Mat6 mass = Mat6::Zero();
  mass.topLeftCorner<3, 3>() = Mat3::Identity() / node.inverse_mass;
  mass.bottomRightCorner<3, 3>() = node.inverse_inertia.inverse();
  return mass;
}

// Of the end of a block that is node number `node`.
Mat6 rowsOf(const JointBlock& block, int node) {
  Mat6 rows = Mat6::Zero();
  for (std::size_t i = 0; i < block.size; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const JointAxis& axis = block.rows[i];
    if (node == block.a)
      rows.row(row) << axis.line.transpose(), axis.turn_a.transpose();
    else
      rows.row(row) << -axis.line.transpose(), -axis.turn_b.transpose();
  }
  return rows;
}

std::size_t numberOf(int node) { return static_cast<std::size_t>(node); }

}  // namespace

JointTrees::JointTrees(const World& world, std::span<JointBlock> blocks)
    : tree_of_(world.bodies.size(), JointBlock::kNone),
      mobility_(world.bodies.size()),
      asked_(world.bodies.size()),
      change_(world.bodies.size()),
      trial_(world.bodies.size()) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].b == Row::kFixed && heldRows(*blocks[i].joint) > 0) grow(Row::kFixed, i, blocks);
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].b != Row::kFixed && heldRows(*blocks[i].joint) > 0) grow(blocks[i].a, i, blocks);
  }
}

// Breadth first, so that every body is nearer to its root than those that hang on it. Nothing where block number
// `first` ends at a body that is of a tree.
void JointTrees::grow(int root, std::size_t first, std::span<JointBlock> blocks) {
  if (tree_of_[numberOf(blocks[first].a)] != JointBlock::kNone) return;
  trees_.push_back({links_.size(), links_.size(), root});
  std::vector<int> bodies;
  if (root == Row::kFixed) {
    bodies.push_back(blocks[first].a);
    blocks[first].in_tree = true;
    links_.push_back({first, blocks[first].a, Row::kFixed});
  } else {
    bodies.push_back(root);
  }
  tree_of_[numberOf(bodies[0])] = static_cast<int>(trees_.size()) - 1;
  for (std::size_t next = 0; next < bodies.size(); ++next) follow(bodies, next, blocks);
  trees_.back().end = links_.size();
  blocks[links_[trees_.back().begin].block].begins_tree = static_cast<int>(trees_.size()) - 1;
}

void JointTrees::follow(std::vector<int>& bodies, std::size_t next, std::span<JointBlock> blocks) {
  const int parent = bodies[next];
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    JointBlock& block = blocks[i];
    if (heldRows(*block.joint) == 0 || (block.a != parent && block.b != parent)) continue;
    const int child = block.a == parent ? block.b : block.a;
    if (child == Row::kFixed || tree_of_[numberOf(child)] != JointBlock::kNone) continue;
    tree_of_[numberOf(child)] = tree_of_[numberOf(parent)];
    block.in_tree = true;
    bodies.push_back(child);
    links_.push_back({i, child, parent});
  }
}

// Of a tree that is among the blocks, all blocks are: so it is there once, where it begins.
template <typename Do>
void JointTrees::forTreesOf(std::span<const std::uint32_t> numbers, std::span<const JointBlock> blocks,
                            Do&& act) const {
  for (const std::uint32_t number : numbers) {
    if (blocks[number].begins_tree != JointBlock::kNone) act(trees_[numberOf(blocks[number].begins_tree)]);
  }
}

void JointTrees::prepare(std::span<const std::uint32_t> numbers, std::span<const JointBlock> blocks,
                         std::span<const Node> nodes) {
  forTreesOf(numbers, blocks, [&](const Tree& tree) { prepare(tree, blocks, nodes); });
}

void JointTrees::copyFrom(const JointTrees& other, std::span<const JointBlock> blocks,
                          std::span<const std::uint32_t> numbers) {
  forTreesOf(numbers, blocks, [&](const Tree& tree) {
    if (tree.root != Row::kFixed) mobility_[numberOf(tree.root)] = other.mobility_[numberOf(tree.root)];
    for (std::size_t i = tree.begin; i < tree.end; ++i) {
      links_[i] = other.links_[i];
      mobility_[numberOf(links_[i].child)] = other.mobility_[numberOf(links_[i].child)];
    }
  });
}

// From the leaves to the root: what hangs on a body adds to its mass in the directions in which it is held.
void JointTrees::prepare(const Tree& tree, std::span<const JointBlock> blocks, std::span<const Node> nodes) {
  std::vector<Mat6>& masses = mobility_;
  if (tree.root != Row::kFixed) masses[numberOf(tree.root)] = massOf(nodes[numberOf(tree.root)]);
  for (std::size_t i = tree.begin; i < tree.end; ++i)
    masses[numberOf(links_[i].child)] = massOf(nodes[numberOf(links_[i].child)]);
  for (std::size_t i = tree.end; i-- > tree.begin;) {
    Link& link = links_[i];
    const JointBlock& block = blocks[link.block];
    Mat6& mobility = mobility_[numberOf(link.child)];
    mobility = inverseOf(masses[numberOf(link.child)]);
    link.of_child = rowsOf(block, link.child);
    Mat6 along = link.of_child * mobility * link.of_child.transpose();
    for (auto row = static_cast<Eigen::Index>(block.size); row < 6; ++row) along(row, row) = 1;
    link.effective_mass = inverseOf(along);
    if (link.parent == Row::kFixed) continue;
    link.of_parent = rowsOf(block, link.parent);
    masses[numberOf(link.parent)] += link.of_parent.transpose() * link.effective_mass * link.of_parent;
  }
  if (tree.root != Row::kFixed) mobility_[numberOf(tree.root)] = inverseOf(masses[numberOf(tree.root)]);
}

// The impulses for what the rows of all links lack.
void JointTrees::answer(const Tree& tree) {
  if (tree.root != Row::kFixed) asked_[numberOf(tree.root)].setZero();
  for (std::size_t i = tree.begin; i < tree.end; ++i) asked_[numberOf(links_[i].child)].setZero();
  for (std::size_t i = tree.end; i-- > tree.begin;) {
    Link& link = links_[i];
    const Vec6 hanging = mobility_[numberOf(link.child)] * asked_[numberOf(link.child)];
    link.impulse = link.effective_mass * (link.missing - link.of_child * hanging);
    if (link.parent != Row::kFixed) asked_[numberOf(link.parent)] += link.of_parent.transpose() * link.impulse;
  }
  if (tree.root != Row::kFixed)
    change_[numberOf(tree.root)] = mobility_[numberOf(tree.root)] * asked_[numberOf(tree.root)];
  for (std::size_t i = tree.begin; i < tree.end; ++i) {
    Link& link = links_[i];
    const std::size_t child = numberOf(link.child);
    if (link.parent != Row::kFixed)
      link.impulse -= link.effective_mass * (link.of_parent * change_[numberOf(link.parent)]);
    change_[child] = mobility_[child] * (link.of_child.transpose() * link.impulse + asked_[child]);
  }
}

void JointTrees::solve(const Tree& tree, std::span<JointBlock> blocks, std::span<Node> nodes) {
  for (std::size_t i = tree.begin; i < tree.end; ++i)
    links_[i].missing = blocks[links_[i].block].wanted - heldVelocities(blocks[links_[i].block], nodes);
  answer(tree);
  for (std::size_t i = tree.begin; i < tree.end; ++i) addHeld(blocks[links_[i].block], nodes, links_[i].impulse);
}

void JointTrees::solve(std::span<const std::uint32_t> numbers, std::span<JointBlock> blocks, std::span<Node> nodes) {
  forTreesOf(numbers, blocks, [&](const Tree& tree) { solve(tree, blocks, nodes); });
}

template <typename Do>
void JointTrees::forTreesOf(const JointBlock& block, Do&& act) const {
  const int of_a = tree_of_[numberOf(block.a)];
  if (of_a != JointBlock::kNone) act(trees_[numberOf(of_a)]);
  if (block.b == Row::kFixed) return;
  const int of_b = tree_of_[numberOf(block.b)];
  if (of_b != JointBlock::kNone && of_b != of_a) act(trees_[numberOf(of_b)]);
}

std::size_t JointTrees::linksNear(const JointBlock& block) const {
  std::size_t links = 0;
  forTreesOf(block, [&](const Tree& tree) { links += tree.end - tree.begin; });
  return links;
}

void JointTrees::solveNear(const JointBlock& block, std::span<JointBlock> blocks, std::span<Node> nodes) {
  forTreesOf(block, [&](const Tree& tree) { solve(tree, blocks, nodes); });
}

std::span<const Node> JointTrees::afterImpulse(const JointAxis& axis, const JointBlock& block,
                                               std::span<const JointBlock> blocks, std::span<const Node> nodes) {
  const auto put = [&](int number) {
    if (number == Row::kFixed) return;
    trial_[numberOf(number)] = nodes[numberOf(number)];
    trial_[numberOf(number)].velocity = trial_[numberOf(number)].spin = Vec3::Zero();
  };
  const auto put_tree = [&](const Tree& tree) {
    put(tree.root);
    for (std::size_t i = tree.begin; i < tree.end; ++i) put(links_[i].child);
  };
  put(block.a);
  put(block.b);
  forTreesOf(block, put_tree);
  pushAlong(axis, block, trial_, 1);
  forTreesOf(block, [&](const Tree& tree) {
    for (std::size_t i = tree.begin; i < tree.end; ++i)
      links_[i].missing = -heldVelocities(blocks[links_[i].block], trial_);
    answer(tree);
    for (std::size_t i = tree.begin; i < tree.end; ++i) pushHeld(blocks[links_[i].block], trial_, links_[i].impulse);
  });
  return trial_;
}

}  // namespace hl
