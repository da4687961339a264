#include "bodies/impacts.h"

#include <algorithm>

#include "bodies/row_solver.h"

namespace hl {

namespace {

// m/s; slower impacts do not bounce, so that what rests comes to rest.
constexpr double kBounces_m_s = 0.02;
// Of impacts, one after another at each row.
constexpr int kMostImpacts = 50;
// Of the kinetic energy: rounding.
constexpr double kNoGain = 1e-9;

bool bounces(const Row& row) { return row.pressed > 0 && row.restitution > 0; }

}  // namespace

Impacts::Impacts(const BodyProblem& problem) : problem_(problem), islands_(problem.nodes.capacity()) {
  free_.reserve(problem.nodes.capacity());
  after_.reserve(problem.nodes.capacity());
  gained_J_.reserve(problem.nodes.capacity());
  joined_.reserve(problem.nodes.capacity());
}

void Impacts::findIslands(const std::vector<Row>& rows) {
  const std::vector<JointBlock>& blocks = problem_.joints.blocks;
  islands_.begin(problem_.nodes.size());
  for (const Row& row : rows) {
    if (row.b != Row::kFixed) islands_.join(row.a, row.b);
  }
  for (const std::uint32_t joint : problem_.awake_joints) {
    if (blocks[joint].b != Row::kFixed) islands_.join(blocks[joint].a, blocks[joint].b);
  }
  joined_.assign(problem_.nodes.size(), 0);
  for (const std::uint32_t joint : problem_.awake_joints)
    joined_[static_cast<std::size_t>(islands_.of(blocks[joint].a))] = 1;
}

bool Impacts::find(std::vector<Row>& rows) {
  const bool any = std::any_of(rows.begin(), rows.end(),
                               [](const Row& row) { return bounces(row) && row.approach < -kBounces_m_s; });
  if (!any) return false;
  findIslands(rows);
  follow(rows);
  for (Row& row : rows) {
    if (!bounces(row)) continue;
    row.solved = Row::Solved::kNo;
    if (!isJoined(row))
      row.least_velocity = std::max(0.0, row.normal.dot(relativeVelocity(row, after_)));
    else if (row.approach < -kBounces_m_s)
      row.least_velocity = -row.restitution * row.approach;
  }
  return true;
}

// One impact after another, where no joints are.
void Impacts::follow(std::vector<Row>& rows) {
  after_ = free_;
  bool approaching = true;
  for (int time = 0; approaching && time < kMostImpacts; ++time) {
    approaching = false;
    for (const Row& row : rows) {
      const double velocity = row.normal.dot(relativeVelocity(row, after_));
      if (!bounces(row) || isJoined(row) || velocity > -kBounces_m_s) continue;
      applyImpulse(row, after_, -(1 + row.restitution) * row.normal_step * velocity * row.normal);
      approaching = true;
    }
  }
}

double Impacts::kineticOf(const Node& node, std::size_t number) const {
  double twice = node.inverse_mass > 0 ? node.velocity.squaredNorm() / node.inverse_mass : 0;
  if (node.inverse_mass > 0 && number < problem_.bodies()) {
    const Vec3 spin_O = problem_.turned[number].transpose() * node.spin;
    twice += spin_O.dot(problem_.world->bodies[number].mass.inertia_kg_m2 * spin_O);
  }
  return twice / 2;
}

// Of all impulses of a joint: springs may well add kinetic energy, as scenery may that moves.
double Impacts::workOf(const JointBlock& block) const {
  double work = block.held.dot(heldVelocities(block, free_) + heldVelocities(block, problem_.nodes)) / 2;
  if (!block.coordinate.there) return work;
  const JointAxis& axis = block.coordinate.axis;
  const double twice_mean = velocityAlong(axis, block, free_) + velocityAlong(axis, block, problem_.nodes);
  return work + block.coordinate.impulses.sum() * twice_mean / 2;
}

bool Impacts::weaken(std::vector<Row>& rows, bool last) {
  gained_J_.assign(problem_.nodes.size(), 0);
  const auto gained = [&](int node) -> double& { return gained_J_[static_cast<std::size_t>(islands_.of(node))]; };
  for (std::size_t i = 0; i < problem_.nodes.size(); ++i) {
    const double before = kineticOf(free_[i], i);
    gained(static_cast<int>(i)) += kineticOf(problem_.nodes[i], i) - (1 + kNoGain) * before;
  }
  for (const std::uint32_t joint : problem_.awake_joints) {
    const JointBlock& block = problem_.joints.blocks[joint];
    gained(block.a) -= workOf(block);
  }
  for (const Row& row : rows) gained(row.a) -= impulseOf(row).dot(row.carried);
  bool any = false;
  for (Row& row : rows) {
    if (!(row.least_velocity > 0) || !(gained(row.a) > 0)) continue;
    row.least_velocity = last ? 0 : row.least_velocity / 2;
    row.solved = Row::Solved::kNo;
    any = true;
  }
  return any;
}

}  // namespace hl
