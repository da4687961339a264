#include "bodies/joint_rows.h"

#include <algorithm>
#include <cmath>

#include "bodies/joint_in_world.h"

namespace hl {

namespace {

// m, or rad of a coordinate: a joint as near as that to its place is there. What is more goes into the velocity from
// kBent on, and is straightened from kStraight on; at most kMaxStraight a step.
constexpr double kBent = 1e-9, kStraight = 1e-10, kMaxStraight_m = 1e-3;

// Of the kinetic energy of its two bodies, what holds a joint may give back this part later.
constexpr double kSpare = 0.01;
constexpr double kSpared_s = 1;

// What of a spring's force is that of the end of the step. With none of it a spring loses nothing: it stores k q q' / 2
// of two successive steps; but it must be softer than 4 m / T^2. So the part grows with T^2 k / m, and at an eighth of
// m / T^2 it is the half that keeps springs of any stiffness stable; bodies between many soft springs have room before.
double implicitPart(double spring, double mobility, double period_s) {
  return std::min(1.0, 4 * period_s * period_s * spring * mobility);
}

double sumOfInverses(const Node& node, double& inertia) {
  inertia += node.inverse_inertia.trace();
  return 3 * node.inverse_mass;
}

}  // namespace

JointRows::JointRows(BodyProblem& problem) : problem_(problem) {
  chord_.ways.resize(problem.bodies());
  chord_.turns.resize(problem.bodies());
  chord_.parts.assign(problem.bodies(), 1);
  off_.resize(problem.joints.blocks.size());
  bent_.resize(problem.joints.blocks.size());
  fed_J_.resize(problem.bodies());
}

Vec3 JointRows::centreOf(int node) const {
  return node == Row::kFixed ? Vec3(Vec3::Zero()) : problem_.nodes[static_cast<std::size_t>(node)].centre;
}

void JointRows::begin(const WorldState& state) {
  JointSet& joints = problem_.joints;
  for (const std::uint32_t i : problem_.awake_joints) beginBlock(state, i);
  joints.trees.prepare(problem_.awake_joints, joints.blocks, problem_.nodes);
  for (const std::uint32_t i : problem_.awake_joints) {
    if (hasCoordinate(joints.blocks[i].joint->kind)) beginCoordinate(state.joints[i], joints.blocks[i]);
    if (joints.blocks[i].closesLoop()) joints.prepareLoop(joints.blocks[i], problem_.nodes);
    prepareJoint(joints.blocks[i], problem_.nodes);
  }
}

void JointRows::beginBlock(const WorldState& state, std::size_t number) {
  JointBlock& block = problem_.joints.blocks[number];
  const JointPlace place = jointPlace(*block.joint, *problem_.world, state);
  double inertias = 0, masses = 0;
  for (const int node : {block.a, block.b}) {
    if (node != Row::kFixed) masses += sumOfInverses(problem_.nodes[static_cast<std::size_t>(node)], inertias);
  }
  block.lever_m = std::sqrt(masses / inertias);
  block.size = heldRows(*block.joint);
  for (std::size_t i = 0; i < block.size; ++i)
    block.rows[i] = place.row(i, block.lever_m, centreOf(block.a), centreOf(block.b));
  block.wanted.setZero();
  block.search.setZero();
  for (std::size_t i = 0; i < 6; ++i) block.held[static_cast<Eigen::Index>(i)] = state.joints[number].held[i];
  off_[number] = place.off(block.lever_m);
  bent_[number] = 0;
  block.coordinate.axis = place.alongCoordinate(centreOf(block.a), centreOf(block.b));
}

void JointRows::beginCoordinate(const JointState& last, JointBlock& block) const {
  const Joint& joint = *block.joint;
  const double period_s = problem_.period_s;
  CoordinateRow& row = block.coordinate;
  row.mobility = problem_.joints.mobilityAlong(block, problem_.nodes);
  row.lever_m = joint.kind == JointKind::kHinge ? block.lever_m : 1;
  row.from = last.coordinate;
  row.pull = -period_s * joint.spring * (row.from - joint.rest);
  row.mass = period_s * (implicitPart(joint.spring, row.mobility, period_s) * period_s * joint.spring + joint.damping);
  row.table = joint.table.empty() ? nullptr : &joint.table;
  row.most_rubbed = period_s * joint.friction;
  setLimits(block, 0);
  row.there = !isRod(joint) && (joint.spring > 0 || joint.damping > 0 || joint.friction > 0 || row.table != nullptr ||
                                std::isfinite(joint.low) || std::isfinite(joint.high));
  row.impulses = Vec3(last.along[0], last.along[1], last.along[2]);
  row.search.setZero();
}

// What the limits leave to the velocity, where the coordinate ends `bent` beyond it.
void JointRows::setLimits(JointBlock& block, double bent) const {
  CoordinateRow& row = block.coordinate;
  row.least = (std::min(block.joint->low - row.from, 0.0) - bent) / problem_.period_s;
  row.most = (std::max(block.joint->high - row.from, 0.0) - bent) / problem_.period_s;
}

void JointRows::findSpeeds(std::span<double> speeds) const {
  for (const std::uint32_t i : problem_.awake_joints) {
    const JointBlock& block = problem_.joints.blocks[i];
    const CoordinateRow& row = block.coordinate;
    double impulse = std::abs(row.pull);
    if (row.table != nullptr)
      impulse += problem_.period_s * std::max(std::abs(row.table->lowest()), std::abs(row.table->highest()));
    double speed = std::min(off_[i].norm(), kMaxStraight_m) / problem_.period_s;
    for (const int number : {block.a, block.b}) {
      if (number == Row::kFixed || impulse == 0) continue;
      const auto body = static_cast<std::size_t>(number);
      const Node& node = problem_.nodes[body];
      const Vec3& turn = number == block.a ? row.axis.turn_a : row.axis.turn_b;
      speed += impulse * (node.inverse_mass * row.axis.line.norm() +
                          (node.inverse_inertia * turn).norm() * problem_.reachOf(body));
    }
    for (const int number : {block.a, block.b}) {
      if (number == Row::kFixed) continue;
      double& most = speeds[static_cast<std::size_t>(number)];
      most = std::max(most, speed);
    }
  }
}

JointPlace JointRows::placeAtEnd(const WorldState& state, const JointBlock& block, const BodyWays& plan) const {
  const auto pose = [&](int number) {
    return number == Row::kFixed ? Pose() : problem_.poseAtEnd(state, static_cast<std::size_t>(number), plan);
  };
  return {*block.joint, pose(block.a), pose(block.b)};
}

bool JointRows::bend(const WorldState& state) {
  const double period_s = problem_.period_s;
  for (const std::size_t i : problem_.awake) {
    chord_.ways[i] = period_s * problem_.nodes[i].velocity;
    chord_.turns[i] = problem_.nodes[i].spin;
  }
  bool again = false;
  for (const std::uint32_t i : problem_.awake_joints) {
    JointBlock& block = problem_.joints.blocks[i];
    const Joint& joint = *block.joint;
    const JointPlace end = placeAtEnd(state, block, chord_);
    const Vec6 missed = end.off(block.lever_m) - off_[i];
    if (missed.norm() > kBent) {
      block.wanted -= missed / period_s;
      again = true;
    }
    CoordinateRow& row = block.coordinate;
    if (!row.there) continue;
    const double at_end = end.coordinate(row.from);
    const double bent = at_end - row.from - period_s * velocityAlong(row.axis, block, problem_.nodes);
    const bool passed =
        at_end > std::max(joint.high, row.from) + kBent || at_end < std::min(joint.low, row.from) - kBent;
    if (!passed && row.impulses[CoordinateRow::kStopped] == 0) continue;
    again |= std::abs(bent - bent_[i]) > kBent;
    bent_[i] = bent;
    setLimits(block, bent);
  }
  return again;
}

double JointRows::heldWork_J(const JointBlock& block) const {
  const Vec6 twice_mean = heldVelocities(block, problem_.before) + heldVelocities(block, problem_.nodes);
  return block.held.dot(twice_mean) / 2;
}

double JointRows::kinetic_J(const JointBlock& block) const {
  double sum = 0;
  for (const int number : {block.a, block.b}) {
    if (number == Row::kFixed) continue;
    const Node& node = problem_.nodes[static_cast<std::size_t>(number)];
    sum += node.velocity.squaredNorm() / node.inverse_mass + node.spin.dot(node.inverse_inertia.inverse() * node.spin);
  }
  return sum / 2;
}

// What is taken is spared up to `most_J`, and forgotten in time.
void JointRows::spare(double& spare_J, double given_J, double most_J) const {
  const double now_J = spare_J - given_J;
  spare_J = given_J < 0 ? std::max(spare_J, std::min(now_J, most_J)) : now_J;
  if (spare_J > 0) spare_J *= std::max(0.0, 1 - problem_.period_s / kSpared_s);
}

bool JointRows::refuse(const WorldState& state) {
  const std::vector<JointBlock>& blocks = problem_.joints.blocks;
  for (const std::uint32_t i : problem_.awake_joints) fed_J_[groupOf(blocks[i])] = 0;
  for (const std::uint32_t i : problem_.awake_joints)
    fed_J_[groupOf(blocks[i])] += heldWork_J(blocks[i]) - state.joints[i].spare_J;
  bool any = false;
  for (const std::uint32_t i : problem_.awake_joints) {
    JointBlock& block = problem_.joints.blocks[i];
    if (fed_J_[groupOf(block)] <= 0 || (block.wanted.isZero(0) && bent_[i] == 0)) continue;
    block.wanted.setZero();
    setLimits(block, bent_[i] = 0);
    any = true;
  }
  return any;
}

double JointRows::straighten(const WorldState& state, const BodyWays& plan, JointSet& apart) const {
  apart.copyFrom(problem_.joints, problem_.awake_joints);
  double worst = 0;
  for (const std::uint32_t i : problem_.awake_joints) {
    JointBlock& block = apart.blocks[i];
    const Joint& joint = *block.joint;
    const JointPlace end = placeAtEnd(state, block, plan);
    Vec6 off = end.off(block.lever_m);
    if (off.norm() > kMaxStraight_m) off *= kMaxStraight_m / off.norm();
    block.wanted = -off / problem_.period_s;
    block.held.setZero();
    block.least_change = 0;
    CoordinateRow limits;
    limits.there = block.coordinate.there;
    limits.mass = problem_.period_s * problem_.period_s * joint.spring;  // it is not to be stretched
    limits.axis = block.coordinate.axis;
    limits.mobility = block.coordinate.mobility;
    limits.lever_m = block.coordinate.lever_m;
    const double at_end = end.coordinate(block.coordinate.from), most = kMaxStraight_m / limits.lever_m;
    limits.least = std::min(joint.low - at_end, most) / problem_.period_s;
    limits.most = std::max(joint.high - at_end, -most) / problem_.period_s;
    block.coordinate = limits;
    worst = std::max(worst, off.norm());
    if (limits.there)
      worst = std::max({worst, limits.lever_m * (joint.low - at_end), limits.lever_m * (at_end - joint.high)});
  }
  return worst > kStraight ? worst : 0;
}

void JointRows::book(WorldState& state) const {
  EnergyBook& energy = state.energy;
  for (const std::uint32_t i : problem_.awake_joints) {
    const JointBlock& block = problem_.joints.blocks[i];
    const double held_J = heldWork_J(block);
    energy.solver_J += held_J;
    spare(state.joints[i].spare_J, held_J, kSpare * kinetic_J(block));
    const auto mean = [&](const JointAxis& axis) {
      return (velocityAlong(axis, block, problem_.before) + velocityAlong(axis, block, problem_.nodes)) / 2;
    };
    const CoordinateRow& row = block.coordinate;
    if (!row.there) continue;
    const double along = mean(row.axis);
    const double damped = -problem_.period_s * block.joint->damping * velocityAlong(row.axis, block, problem_.nodes);
    energy.joint_damping_J -= damped * along;
    energy.joint_friction_J -= row.impulses[CoordinateRow::kRubbed] * along;
    energy.joint_limit_J -= row.impulses[CoordinateRow::kStopped] * along;
    energy.solver_J += (row.impulses[CoordinateRow::kDriven] - damped) * along;
  }
}

void JointRows::remember(WorldState& state) const {
  for (const std::uint32_t i : problem_.awake_joints) {
    const JointBlock& block = problem_.joints.blocks[i];
    JointState& one = state.joints[i];
    const double before_J = springEnergy_J(*block.joint, one.coordinate);
    one.coordinate = jointPlace(*block.joint, *problem_.world, state).coordinate(one.coordinate);
    state.energy.solver_J += springEnergy_J(*block.joint, one.coordinate) - before_J;
    one.velocity = velocityAlong(block.coordinate.axis, block, problem_.nodes);
    for (std::size_t row = 0; row < 6; ++row) one.held[row] = block.held[static_cast<Eigen::Index>(row)];
    for (std::size_t cause = 0; cause < 3; ++cause)
      one.along[cause] = block.coordinate.impulses[static_cast<Eigen::Index>(cause)];
  }
}

}  // namespace hl
