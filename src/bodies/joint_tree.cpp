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

}  // namespace

JointTree::JointTree(const World& world, std::span<JointBlock> blocks) {
  std::vector<bool> reached(world.bodies.size(), false);
  grow({Row::kFixed}, blocks, reached);
  for (const JointBlock& block : blocks) {
    if (reached[static_cast<std::size_t>(block.a)]) continue;
    reached[static_cast<std::size_t>(block.a)] = true;
    roots_.push_back(block.a);
    grow({block.a}, blocks, reached);
  }
  mobility_.resize(world.bodies.size());
  asked_.resize(world.bodies.size());
  change_.resize(world.bodies.size());
}

// Breadth first, so that every body is nearer to its root than those that hang on it.
void JointTree::grow(std::vector<int> bodies, std::span<JointBlock> blocks, std::vector<bool>& reached) {
  for (std::size_t next = 0; next < bodies.size(); ++next) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      JointBlock& block = blocks[i];
      const int parent = bodies[next];
      if (heldRows(block.joint->kind) == 0 || (block.a != parent && block.b != parent)) continue;
      const int child = block.a == parent ? block.b : block.a;
      if (child == Row::kFixed || reached[static_cast<std::size_t>(child)]) continue;
      reached[static_cast<std::size_t>(child)] = true;
      block.in_tree = true;
      bodies.push_back(child);
      Link link;
      link.block = i;
      link.child = child;
      link.parent = parent;
      links_.push_back(link);
    }
  }
}

// From the leaves to the roots: what hangs on a body adds to its mass in the directions in which it is held.
void JointTree::prepare(std::span<const JointBlock> blocks, std::span<const Node> nodes) {
  std::vector<Mat6>& masses = mobility_;
  for (const int root : roots_) masses[static_cast<std::size_t>(root)] = massOf(nodes[static_cast<std::size_t>(root)]);
  for (const Link& link : links_)
    masses[static_cast<std::size_t>(link.child)] = massOf(nodes[static_cast<std::size_t>(link.child)]);
  for (auto at = links_.rbegin(); at != links_.rend(); ++at) {
    Link& link = *at;
    const JointBlock& block = blocks[link.block];
    Mat6& mobility = mobility_[static_cast<std::size_t>(link.child)];
    mobility = inverseOf(masses[static_cast<std::size_t>(link.child)]);
    link.of_child = rowsOf(block, link.child);
    Mat6 along = link.of_child * mobility * link.of_child.transpose();
    for (auto i = static_cast<Eigen::Index>(block.size); i < 6; ++i) along(i, i) = 1;
    link.effective_mass = inverseOf(along);
    if (link.parent == Row::kFixed) continue;
    link.of_parent = rowsOf(block, link.parent);
    masses[static_cast<std::size_t>(link.parent)] += link.of_parent.transpose() * link.effective_mass * link.of_parent;
  }
  for (const int root : roots_)
    mobility_[static_cast<std::size_t>(root)] = inverseOf(masses[static_cast<std::size_t>(root)]);
}

void JointTree::solve(std::span<JointBlock> blocks, std::span<Node> nodes) {
  for (const int root : roots_) asked_[static_cast<std::size_t>(root)].setZero();
  for (const Link& link : links_) asked_[static_cast<std::size_t>(link.child)].setZero();
  for (auto at = links_.rbegin(); at != links_.rend(); ++at) {
    Link& link = *at;
    const auto child = static_cast<std::size_t>(link.child);
    const Vec6 hanging = mobility_[child] * asked_[child];
    const Vec6 missing = missingVelocities(blocks[link.block], nodes) - link.of_child * hanging;
    link.asked = link.effective_mass * missing;
    if (link.parent != Row::kFixed)
      asked_[static_cast<std::size_t>(link.parent)] += link.of_parent.transpose() * link.asked;
  }
  for (const int root : roots_) {
    const auto body = static_cast<std::size_t>(root);
    change_[body] = mobility_[body] * asked_[body];
  }
  for (const Link& link : links_) {
    const auto child = static_cast<std::size_t>(link.child);
    JointBlock& block = blocks[link.block];
    block.change = link.asked;
    if (link.parent != Row::kFixed)
      block.change -= link.effective_mass * (link.of_parent * change_[static_cast<std::size_t>(link.parent)]);
    change_[child] = mobility_[child] * (link.of_child.transpose() * block.change + asked_[child]);
  }
  for (const Link& link : links_) pushHeld(blocks[link.block], nodes);
}

}  // namespace hl
