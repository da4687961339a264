#include "bodies/held_bodies.h"

#include <algorithm>
#include <cmath>

namespace hl {

HeldBodies::HeldBodies(BodyProblem& problem, MotionPlan& plan)
    : problem_(problem),
      plan_(plan),
      islands_(problem.bodies()),
      clusters_(problem.bodies()),
      kept_(problem.bodies(), 1) {}

double HeldBodies::kineticEnergy_J(std::size_t body) const {
  const Node& node = problem_.nodes[body];
  const Mass& mass = problem_.world->bodies[body].mass;
  const Vec3 spin = problem_.turned[body].transpose() * node.spin;
  return (mass.mass_kg * node.velocity.squaredNorm() + spin.dot(mass.inertia_kg_m2 * spin)) / 2;
}

// Whether it goes a part of its way only in this step, as in the one before. What sleeps does not go.
bool HeldBodies::isHeld(const WorldState& state, int body) const {
  const auto i = static_cast<std::size_t>(body);
  return state.bodies[i].island == 0 && state.bodies[i].stopped_short > 0 && plan_.ways().parts[i] < 1;
}

// Joined bodies go the same part of their ways, and are one group.
void HeldBodies::findClusters(const WorldState& state) {
  islands_.begin(problem_.bodies());
  for (const std::size_t i : problem_.awake) {
    clusters_[i] = Cluster();
    if (isHeld(state, static_cast<int>(i))) islands_.join(static_cast<int>(i), static_cast<int>(problem_.groups[i]));
  }
  const auto among_held = [&](const MotionPlan::Stop& stop) {
    return stop.b != Row::kFixed && isHeld(state, stop.a) && isHeld(state, stop.b);
  };
  for (const MotionPlan::Stop& stop : plan_.stops()) {
    if (among_held(stop)) islands_.join(stop.a, stop.b);
  }
  // When all are joined.
  for (const MotionPlan::Stop& stop : plan_.stops()) {
    if (among_held(stop)) clusterOf(static_cast<std::size_t>(stop.a)).sticks = true;
  }
}

// By the scene, a hand, what sleeps or a joint to the world.
void HeldBodies::findFixed() {
  const auto moves = [&](int node) {
    return node != Row::kFixed && static_cast<std::size_t>(node) < problem_.bodies() &&
           problem_.nodes[static_cast<std::size_t>(node)].inverse_mass > 0;
  };
  const auto add = [&](int a, int b) {
    if (moves(a) && !moves(b)) clusterOf(static_cast<std::size_t>(a)).fixed = true;
    if (moves(b) && !moves(a)) clusterOf(static_cast<std::size_t>(b)).fixed = true;
  };
  for (const MotionPlan::Stop& stop : plan_.stops()) add(stop.a, stop.b);
  for (const std::uint32_t number : problem_.awake_joints)
    add(problem_.joints.blocks[number].a, problem_.joints.blocks[number].b);
  for (const Row& row : problem_.rows) {
    if (row.pressed > 0) add(row.a, row.b);
  }
}

void HeldBodies::measureClusters(const WorldState& state) {
  const auto for_each_stuck = [&](const auto& act) {
    for (const std::size_t i : problem_.awake) {
      if (Cluster& cluster = clusterOf(i); cluster.sticks)
        act(cluster, i, problem_.nodes[i], problem_.world->bodies[i].mass.mass_kg);
    }
  };
  const auto for_each_cluster = [&](const auto& act) {
    for (const std::size_t i : problem_.awake) {
      if (clusters_[i].sticks) act(clusters_[i]);
    }
  };
  for_each_cluster([](Cluster& cluster) {
    const bool fixed = cluster.fixed;
    cluster = Cluster();
    cluster.sticks = true;
    cluster.fixed = fixed;
  });
  for_each_stuck([](Cluster& cluster, std::size_t, const Node& node, double mass_kg) {
    cluster.mass_kg += mass_kg;
    cluster.centre += mass_kg * node.centre;
    cluster.velocity += mass_kg * node.velocity;
  });
  for_each_cluster([](Cluster& cluster) {
    cluster.centre /= cluster.mass_kg;
    cluster.velocity /= cluster.mass_kg;
  });
  for_each_stuck([&](Cluster& cluster, std::size_t body, const Node& node, double mass_kg) {
    const Mat3 inertia = inertiaOf(problem_.world->bodies[body], state.bodies[body]);
    const Vec3 arm = node.centre - cluster.centre;
    cluster.angular_momentum += inertia * node.spin + mass_kg * arm.cross(node.velocity - cluster.velocity);
    cluster.inertia += inertia + mass_kg * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  });
  for_each_cluster([](Cluster& cluster) { cluster.spin = cluster.inertia.ldlt().solve(cluster.angular_momentum); });
}

// Its bodies turn about their common centre of mass, and fall as one.
bool HeldBodies::goesAsOne(const WorldState& state, int number) {
  const Cluster& cluster = clusters_[static_cast<std::size_t>(number)];
  const double period_s = problem_.period_s;
  const Eigen::Quaterniond turn = rotationBy(period_s * cluster.spin);
  const Vec3 way = period_s * cluster.velocity - period_s * period_s / 2 * problem_.world->gravity_m_s2;
  const auto is_of = [&](std::size_t body) { return islands_.of(static_cast<int>(body)) == number; };
  return plan_.goOtherwise(state, is_of, [&](std::size_t body) {
    const Vec3 arm = problem_.nodes[body].centre - cluster.centre;
    return std::pair(Vec3(way + turn * arm - arm), cluster.spin);
  });
}

void HeldBodies::plan(const WorldState& state) {
  any_ = std::any_of(problem_.awake.begin(), problem_.awake.end(),
                     [&](std::size_t i) { return plan_.ways().parts[i] < 1; });
  if (!any_) return;
  findClusters(state);
  findFixed();
  measureClusters(state);
  for (const std::size_t i : problem_.awake) {
    Cluster& cluster = clusters_[i];
    if (cluster.sticks && !cluster.fixed) cluster.fixed = !goesAsOne(state, static_cast<int>(i));
  }
}

// The part of its velocity that a group keeps. `held`: by the scene, or by nothing that is known.
double HeldBodies::keptBy(std::uint32_t group, double part, bool held) const {
  if (held) return part;
  double kinetic_J = 0, not_fallen_J = 0;
  for (const std::size_t i : problem_.awake) {
    if (problem_.groups[i] != group) continue;
    kinetic_J += kineticEnergy_J(i);
    const Vec3 not_gone = (1 - part) * plan_.ways().ways[i];
    not_fallen_J += problem_.world->bodies[i].mass.mass_kg * problem_.world->gravity_m_s2.dot(not_gone);
  }
  return not_fallen_J > 0 ? std::sqrt(std::max(0.0, 1 - not_fallen_J / kinetic_J)) : 1;
}

void HeldBodies::slow(WorldState& state) {
  if (!any_) {
    for (const std::size_t i : problem_.awake) state.bodies[i].stopped_short = 0;
    return;
  }
  measureClusters(state);
  for (const std::size_t i : problem_.awake) {
    const Cluster& cluster = clusterOf(i);
    const bool as_one = cluster.sticks && !cluster.fixed;
    const double part = plan_.ways().parts[i];
    int& stopped_short = state.bodies[i].stopped_short;
    stopped_short = part < 1 || as_one ? stopped_short + 1 : 0;
    if (stopped_short == 0) continue;
    Node& node = problem_.nodes[i];
    const double before_J = kineticEnergy_J(i);
    if (as_one) {
      node.spin = cluster.spin;
      node.velocity = cluster.velocity + cluster.spin.cross(node.centre - cluster.centre);
    } else {
      // The first of a group, which is slowed at once.
      if (problem_.groups[i] == i) kept_[i] = keptBy(problem_.groups[i], part, stopped_short > 1);
      node.velocity *= kept_[problem_.groups[i]];
      node.spin *= kept_[problem_.groups[i]];
    }
    state.energy.contact_J += before_J - kineticEnergy_J(i);
  }
}

}  // namespace hl
