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

}  // namespace

Impacts::Impacts(const BodyProblem& problem) : problem_(problem), islands_(problem.nodes.capacity(), 0) {
  free_.reserve(problem.nodes.capacity());
  after_.reserve(problem.nodes.capacity());
  gained_J_.reserve(problem.nodes.capacity());
}

bool Impacts::find(std::vector<Row>& rows) {
  const auto bounces = [](const Row& row) { return row.pressed > 0 && row.restitution > 0; };
  const bool any = std::any_of(rows.begin(), rows.end(),
                               [&](const Row& row) { return bounces(row) && row.approach < -kBounces_m_s; });
  if (!any) return false;
  after_ = free_;
  bool approaching = true;
  for (int time = 0; approaching && time < kMostImpacts; ++time) {
    approaching = false;
    for (const Row& row : rows) {
      const double velocity = row.normal.dot(relativeVelocity(row, after_));
      if (!bounces(row) || velocity > -kBounces_m_s) continue;
      applyImpulse(row, after_, -(1 + row.restitution) * row.normal_step * velocity * row.normal);
      approaching = true;
    }
  }
  for (Row& row : rows) {
    if (bounces(row)) row.least_velocity = std::max(0.0, row.normal.dot(relativeVelocity(row, after_)));
  }
  return true;
}

double Impacts::kineticOf(const Node& node, std::size_t number) const {
  double twice = node.inverse_mass > 0 ? node.velocity.squaredNorm() / node.inverse_mass : 0;
  if (node.inverse_mass > 0 && number < problem_.bodies()) {
    const Vec3 spin_O = problem_.turned[number].transpose() * node.spin;
    twice += spin_O.dot(problem_.world->bodies[number].mass.inertia_kg_m2 * spin_O);
  }
  return twice / 2;
}

bool Impacts::weaken(std::vector<Row>& rows, bool last) {
  islands_.begin(problem_.nodes.size());
  for (const Row& row : rows) {
    if (row.b != Row::kFixed) islands_.join(row.a, row.b);
  }
  gained_J_.assign(problem_.nodes.size(), 0);
  for (std::size_t i = 0; i < problem_.nodes.size(); ++i) {
    const double before = kineticOf(free_[i], i);
    gained_J_[static_cast<std::size_t>(islands_.of(static_cast<int>(i)))] +=
        kineticOf(problem_.nodes[i], i) - (1 + kNoGain) * before;
  }
  bool any = false;
  for (Row& row : rows) {
    if (!(row.least_velocity > 0) || !(gained_J_[static_cast<std::size_t>(islands_.of(row.a))] > 0)) continue;
    row.least_velocity = last ? 0 : row.least_velocity / 2;
    any = true;
  }
  return any;
}

}  // namespace hl
