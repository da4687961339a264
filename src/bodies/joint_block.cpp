#include "bodies/joint_block.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// N s that rounding of the velocities may make.
double leastChange(const JointBlock& block, std::span<const Node> nodes) {
  double speed = 0, mobility = std::max(block.coordinate.mobility, 0.0);
  for (const int number : {block.a, block.b}) {
    if (number == Row::kFixed) continue;
    const Node& node = nodes[static_cast<std::size_t>(number)];
    speed += node.velocity.norm() + block.lever_m * node.spin.norm();
    mobility = std::max(mobility, node.inverse_mass);
  }
  constexpr double kSpeedRounding = 1e-13;
  return mobility > 0 ? kSpeedRounding * speed / mobility : 0;
}

// The velocity along the coordinate with spring, damper and table, where all else has left it at `free`. The table's
// impulse is T times its mean over the way of the step: its work on a body never exceeds what its potential gives,
// whatever its slopes and however light the body. Its forces have bounds, so there is a root between two velocities.
double drivenVelocity(const CoordinateRow& row, double free, double now, double period_s) {
  const double whole = 1 + row.mobility * row.mass;
  const double straight = free + row.mobility * row.pull;
  if (row.table == nullptr) return straight / whole;
  const double pushes = row.mobility * period_s;
  double low = (straight + pushes * row.table->lowest()) / whole;
  double high = (straight + pushes * row.table->highest()) / whole;
  const auto excess = [&](double v) {
    return whole * v - straight - pushes * row.table->meanBetween(row.from, row.from + period_s * v);
  };
  constexpr int kMaxTries = 100;
  const double done = 1e-15 * (std::abs(low) + std::abs(high));
  double at_low = excess(low), at_high = excess(high), v = std::clamp(now, low, high);
  for (int i = 0; i < kMaxTries && high - low > done; ++i) {
    const double value = excess(v);
    if (value == 0) return v;
    (value < 0 ? low : high) = v;
    (value < 0 ? at_low : at_high) = value;
    const double line = low - at_low * (high - low) / (at_high - at_low);
    v = i % 3 != 2 && line > low && line < high ? line : (low + high) / 2;
  }
  return v;
}

// Spring, damper and table as if nothing else acted; then friction toward rest, then what limits leave; spring and
// damper answer these at once.
Vec3 solveAlong(CoordinateRow& row, const JointBlock& block, std::span<Node> nodes, double period_s) {
  const Vec3 before = row.impulses;
  double velocity = velocityAlong(row.axis, block, nodes);
  const double free = velocity - row.mobility * row.impulses[CoordinateRow::kDriven];
  double next =
      row.mass == 0 && row.pull == 0 && row.table == nullptr ? free : drivenVelocity(row, free, velocity, period_s);
  row.impulses[CoordinateRow::kDriven] += (next - velocity) / row.mobility;
  const double whole_mass = 1 / row.mobility + row.mass;
  const auto add = [&](CoordinateRow::Cause cause, double impulse) {
    const double change = impulse - row.impulses[cause];
    row.impulses[cause] = impulse;
    row.impulses[CoordinateRow::kDriven] -= row.mass * change / whole_mass;
    next += change / whole_mass;
  };
  if (row.most_rubbed > 0) {
    const double wanted = row.impulses[CoordinateRow::kRubbed] - whole_mass * next;
    add(CoordinateRow::kRubbed, std::clamp(wanted, -row.most_rubbed, row.most_rubbed));
  }
  const double stopped = row.impulses[CoordinateRow::kStopped];
  const double at_least = stopped + whole_mass * (row.least - next), at_most = stopped + whole_mass * (row.most - next);
  add(CoordinateRow::kStopped, std::max(0.0, at_least) + std::min(0.0, at_most));
  const Vec3 change = row.impulses - before;
  pushAlong(row.axis, block, nodes, change.sum());
  return change;
}

}  // namespace

double velocityAlong(const JointAxis& axis, const JointBlock& block, std::span<const Node> nodes) {
  const Node& a = nodes[static_cast<std::size_t>(block.a)];
  double velocity = axis.line.dot(a.velocity) + axis.turn_a.dot(a.spin);
  if (block.b == Row::kFixed) return velocity;
  const Node& b = nodes[static_cast<std::size_t>(block.b)];
  return velocity - axis.line.dot(b.velocity) - axis.turn_b.dot(b.spin);
}

void pushAlong(const JointAxis& axis, const JointBlock& block, std::span<Node> nodes, double impulse_N_s) {
  Node& a = nodes[static_cast<std::size_t>(block.a)];
  a.velocity += a.inverse_mass * impulse_N_s * axis.line;
  a.spin += a.inverse_inertia * (impulse_N_s * axis.turn_a);
  if (block.b == Row::kFixed) return;
  Node& b = nodes[static_cast<std::size_t>(block.b)];
  b.velocity -= b.inverse_mass * impulse_N_s * axis.line;
  b.spin -= b.inverse_inertia * (impulse_N_s * axis.turn_b);
}

double mobilityBetween(const JointAxis& of, const JointAxis& row, const JointBlock& block,
                       std::span<const Node> nodes) {
  const Node& a = nodes[static_cast<std::size_t>(block.a)];
  double sum = a.inverse_mass * of.line.dot(row.line) + of.turn_a.dot(a.inverse_inertia * row.turn_a);
  if (block.b == Row::kFixed) return sum;
  const Node& b = nodes[static_cast<std::size_t>(block.b)];
  return sum + b.inverse_mass * of.line.dot(row.line) + of.turn_b.dot(b.inverse_inertia * row.turn_b);
}

Vec6 heldVelocities(const JointBlock& block, std::span<const Node> nodes) {
  Vec6 velocities = Vec6::Zero();
  for (std::size_t i = 0; i < block.size; ++i)
    velocities[static_cast<Eigen::Index>(i)] = velocityAlong(block.rows[i], block, nodes);
  return velocities;
}

void pushHeld(const JointBlock& block, std::span<Node> nodes, const Vec6& impulses) {
  for (std::size_t i = 0; i < block.size; ++i)
    pushAlong(block.rows[i], block, nodes, impulses[static_cast<Eigen::Index>(i)]);
}

void addHeld(JointBlock& block, std::span<Node> nodes, const Vec6& impulses) {
  block.held += impulses;
  block.change += impulses;
  pushHeld(block, nodes, impulses);
}

void prepareJoint(JointBlock& block, std::span<Node> nodes) {
  block.least_change = leastChange(block, nodes);
  pushHeld(block, nodes, block.held);
  CoordinateRow& coordinate = block.coordinate;
  if (coordinate.there) pushAlong(coordinate.axis, block, nodes, coordinate.impulses.sum());
}

void solveHeld(JointBlock& block, std::span<Node> nodes) {
  addHeld(
      block, nodes,
      block.effective_mass * (block.wanted - heldVelocities(block, nodes) - block.softness.cwiseProduct(block.held)));
}

void solveCoordinate(JointBlock& block, std::span<Node> nodes, double period_s) {
  block.coordinate.change = solveAlong(block.coordinate, block, nodes, period_s);
}

BlockSweep sweepOf(const JointBlock& block) {
  BlockSweep sweep{block.change.squaredNorm(), block.held.squaredNorm()};
  const CoordinateRow& coordinate = block.coordinate;
  if (!coordinate.there) return sweep;
  const double per_m = 1 / (coordinate.lever_m * coordinate.lever_m);
  sweep.change += per_m * coordinate.change.squaredNorm();
  sweep.largest = std::max(sweep.largest, per_m * coordinate.impulses.squaredNorm());
  return sweep;
}

void searchJointOn(JointBlock& block, std::span<Node> nodes, double part, bool anew) {
  CoordinateRow& coordinate = block.coordinate;
  if (anew) {
    block.search = block.change;
    coordinate.search = coordinate.change;
    return;
  }
  const Vec6 way = part * block.search;
  block.held += way;
  pushHeld(block, nodes, way);
  block.search = way + block.change;
  if (!coordinate.there) return;
  const Vec3 along = part * coordinate.search;
  coordinate.impulses += along;
  pushAlong(coordinate.axis, block, nodes, along.sum());
  coordinate.search = along + coordinate.change;
}

}  // namespace hl
