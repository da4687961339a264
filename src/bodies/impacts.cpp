#include "bodies/impacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/fixed_vector.h"
#include "bodies/row_solver.h"

namespace hl {

namespace {

// m/s; slower impacts do not bounce, so that what rests comes to rest.
constexpr double kBounces_m_s = 0.02;
// Of impacts, one after another at each row.
constexpr int kMaxImpacts = 50;
// Rows of one pair that bounce as one.
constexpr std::size_t kMaxTogether = 16;
// Over them (in piles 99 of 100 pairs take 40 or less; what still approaches then is the next impact), and m/s by which
// the last sweep may have changed one.
constexpr int kMaxSweeps = 40;
constexpr double kAgree_m_s = 1e-12;
// Of the kinetic energy: rounding.
constexpr double kNoGain = 1e-9;

bool bounces(const Row& row) { return row.pressed > 0 && row.restitution > 0; }

bool samePair(const Row& x, const Row& y) { return x.a == y.a && x.b == y.b; }

}  // namespace

Impacts::Impacts(const BodyProblem& problem) : problem_(problem), islands_(problem.nodes.capacity()) {
  free_.reserve(problem.nodes.capacity());
  after_.reserve(problem.nodes.capacity());
  gained_J_.reserve(problem.nodes.capacity());
  before_.reserve(problem.nodes.capacity());
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

double Impacts::speedByGravity(const Row& row) const {
  const auto falls = [&](int number) {
    if (number == Row::kFixed || static_cast<std::size_t>(number) >= problem_.bodies()) return false;
    return free_[static_cast<std::size_t>(number)].inverse_mass > 0;
  };
  const double speed_m_s = problem_.period_s * row.normal.dot(problem_.world->gravity_m_s2);
  return (falls(row.a) ? speed_m_s : 0) - (falls(row.b) ? speed_m_s : 0);
}

// The part s, 0..1, of the step in which the gap d T closes: d + v s + w s^2 / 2 = 0, v before gravity, w by gravity.
double Impacts::partBefore(const Row& row) const {
  const double gap_m_s = std::max(0.0, row.gap) / problem_.period_s;
  const double by_gravity_m_s = speedByGravity(row);
  const double begin_m_s = row.normal.dot(relativeVelocity(row, free_)) - by_gravity_m_s;
  const double root_m_s = std::sqrt(std::max(0.0, begin_m_s * begin_m_s - 2 * by_gravity_m_s * gap_m_s));
  return root_m_s > begin_m_s ? std::min(1.0, 2 * gap_m_s / (root_m_s - begin_m_s)) : 1;
}

void Impacts::stopWhereTheyMeet(const std::vector<Row>& rows) {
  before_.assign(problem_.nodes.size(), 1);
  for (const Row& row : rows) {
    double& before = before_[static_cast<std::size_t>(islands_.of(row.a))];
    if (bounces(row) && row.approach < -kBounces_m_s) before = std::min(before, partBefore(row));
  }
  for (const std::size_t i : problem_.awake) {
    const double after = 1 - before_[static_cast<std::size_t>(islands_.of(static_cast<int>(i)))];
    after_[i].velocity -= after * problem_.period_s * problem_.world->gravity_m_s2;
  }
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
      row.least_velocity = -row.restitution * (row.approach - (1 - partBefore(row)) * speedByGravity(row));
  }
  return true;
}

// The rows of one pair. Each that approaches gets an impulse >= 0 that makes it go apart by e of how it approached, or
// none where others make it go faster (projected Gauss-Seidel). False: none approaches.
bool Impacts::bounce(std::span<const Row> pair) {
  struct Bounce {
    const Row* row;
    double apart_m_s, impulse_N_s = 0;
  };
  FixedVector<Bounce, kMaxTogether> all;
  for (const Row& row : pair) {
    const double velocity = row.normal.dot(relativeVelocity(row, after_));
    if (bounces(row) && !isJoined(row) && velocity <= -kBounces_m_s) all.push({&row, -row.restitution * velocity});
  }
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double farthest_m_s = 0;
    for (Bounce& one : all) {
      const double lacks_m_s = one.apart_m_s - one.row->normal.dot(relativeVelocity(*one.row, after_));
      const double impulse_N_s = std::max(0.0, one.impulse_N_s + one.row->normal_step * lacks_m_s);
      const double change_N_s = impulse_N_s - std::exchange(one.impulse_N_s, impulse_N_s);
      applyImpulse(*one.row, after_, change_N_s * one.row->normal);
      farthest_m_s = std::max(farthest_m_s, std::abs(change_N_s) / one.row->normal_step);
    }
    if (farthest_m_s <= kAgree_m_s) break;
  }
  return !all.empty();
}

// One impact after another, where no joints are.
void Impacts::follow(std::vector<Row>& rows) {
  after_ = free_;
  stopWhereTheyMeet(rows);
  bool approaching = true;
  for (int time = 0; approaching && time < kMaxImpacts; ++time) {
    approaching = false;
    for (std::size_t first = 0, end = 0; first < rows.size(); first = end) {
      for (end = first + 1; end < rows.size() && end - first < kMaxTogether && samePair(rows[first], rows[end]);
           ++end) {
      }
      approaching |= bounce({rows.data() + first, end - first});
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
