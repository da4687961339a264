#include "bodies/held_bodies.h"

#include <algorithm>
#include <cmath>

namespace hl {

HeldBodies::HeldBodies(BodyProblem& problem, const MotionPlan& plan)
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

// Whether it went a part of its way only in this step and in the one before.
bool HeldBodies::isHeld(const WorldState& state, int body) const {
  return state.bodies[static_cast<std::size_t>(body)].stopped_short > 1;
}

void HeldBodies::count(WorldState& state) {
  for (const std::size_t i : problem_.awake) {
    int& stopped_short = state.bodies[i].stopped_short;
    stopped_short = plan_.ways().parts[i] < 1 ? stopped_short + 1 : 0;
  }
}

// Joined bodies go the same part of their ways, and are one group. One that a joint holds to the world is fixed.
void HeldBodies::findClusters(const WorldState& state) {
  islands_.begin(problem_.bodies());
  for (const std::size_t i : problem_.awake) {
    clusters_[i] = Cluster();
    if (state.bodies[i].stopped_short > 1) islands_.join(static_cast<int>(i), static_cast<int>(problem_.groups[i]));
  }
  for (const MotionPlan::Stop& stop : plan_.stops()) {
    if (stop.b != Row::kFixed && isHeld(state, stop.a) && isHeld(state, stop.b)) islands_.join(stop.a, stop.b);
  }
  const auto cluster_of = [&](int body) -> Cluster& { return clusters_[static_cast<std::size_t>(islands_.of(body))]; };
  for (const MotionPlan::Stop& stop : plan_.stops()) {
    if (stop.b != Row::kFixed && isHeld(state, stop.a) && isHeld(state, stop.b)) cluster_of(stop.a).sticks = true;
  }
  for (const MotionPlan::Stop& stop : plan_.stops()) {
    cluster_of(stop.a).stops = true;
    if (stop.b == Row::kFixed) {
      cluster_of(stop.a).fixed = true;
    } else {
      cluster_of(stop.b).stops = true;
    }
  }
  for (const std::uint32_t number : problem_.awake_joints) {
    const JointBlock& joint = problem_.joints.blocks[number];
    if (joint.b == Row::kFixed) cluster_of(joint.a).fixed = true;
    if (joint.a == Row::kFixed) cluster_of(joint.b).fixed = true;
  }
}

void HeldBodies::measureClusters(const WorldState& state) {
  const auto cluster_of = [&](std::size_t body) -> Cluster& {
    return clusters_[static_cast<std::size_t>(islands_.of(static_cast<int>(body)))];
  };
  for (const std::size_t i : problem_.awake) {
    Cluster& cluster = cluster_of(i);
    const double mass_kg = problem_.world->bodies[i].mass.mass_kg;
    cluster.mass_kg += mass_kg;
    cluster.moment += mass_kg * problem_.nodes[i].centre;
    cluster.momentum += mass_kg * problem_.nodes[i].velocity;
  }
  for (const std::size_t i : problem_.awake) {
    Cluster& cluster = cluster_of(i);
    cluster.centre = cluster.moment / cluster.mass_kg;
    cluster.velocity = cluster.momentum / cluster.mass_kg;
  }
  for (const std::size_t i : problem_.awake) {
    Cluster& cluster = cluster_of(i);
    const Node& node = problem_.nodes[i];
    const double mass_kg = problem_.world->bodies[i].mass.mass_kg;
    const Mat3 inertia = inertiaOf(problem_.world->bodies[i], state.bodies[i]);
    const Vec3 arm = node.centre - cluster.centre;
    cluster.angular += inertia * node.spin + mass_kg * arm.cross(node.velocity - cluster.velocity);
    cluster.inertia += inertia + mass_kg * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  for (const std::size_t i : problem_.awake) {
    Cluster& cluster = clusters_[i];
    if (cluster.sticks) cluster.spin = cluster.inertia.ldlt().solve(cluster.angular);
  }
}

// The part of its velocity that a group keeps. `by_scene`: the scene holds it, or nothing that is known.
double HeldBodies::keptBy(std::uint32_t group, double part, bool by_scene) const {
  if (by_scene) return part;
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
  count(state);
  if (plan_.stops().empty() && std::none_of(problem_.awake.begin(), problem_.awake.end(),
                                            [&](std::size_t i) { return state.bodies[i].stopped_short > 0; }))
    return;
  findClusters(state);
  measureClusters(state);
  for (const std::size_t i : problem_.awake) {
    const BodyState& body = state.bodies[i];
    if (body.stopped_short == 0) continue;
    Node& node = problem_.nodes[i];
    const double before_J = kineticEnergy_J(i);
    const Cluster& cluster = clusters_[static_cast<std::size_t>(islands_.of(static_cast<int>(i)))];
    if (cluster.sticks && cluster.isFree()) {
      node.spin = cluster.spin;
      node.velocity = cluster.velocity + cluster.spin.cross(node.centre - cluster.centre);
    } else {
      // The first of a group, which is slowed at once.
      if (problem_.groups[i] == i)
        kept_[i] = keptBy(problem_.groups[i], plan_.ways().parts[i], body.stopped_short > 1 && !cluster.isFree());
      node.velocity *= kept_[problem_.groups[i]];
      node.spin *= kept_[problem_.groups[i]];
    }
    state.energy.contact_J += before_J - kineticEnergy_J(i);
  }
}

}  // namespace hl
