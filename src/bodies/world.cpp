#include "bodies/world.h"

#include <bit>

namespace hl {

namespace {

// FNV-1a, by words.
struct Hash {
  std::uint64_t value = 14695981039346656037u;
  void add(std::uint64_t word) { value = (value ^ word) * 1099511628211u; }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const ContactMemory& memory) {
    for (const RememberedContact& contact : memory) {
      add(contact.pair.a);
      add(contact.pair.b);
      add(contact.place);
      add(contact.pressed);
      add(contact.dragged);
      add(std::uint64_t{contact.slipped});
    }
  }
};

}  // namespace

WorldState startWorld(const World& world, const std::vector<Pose>& poses) {
  WorldState state;
  state.bodies.resize(world.bodies.size());
  state.memory.reserve(mostRows(world));
  state.asleep.reserve(mostRows(world));
  state.gravity_m_s2 = world.gravity_m_s2;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    BodyState& body = state.bodies[i];
    body.turned = Eigen::Quaterniond(poses[i].rotation).normalized();
    body.centre = poses[i].toWorld(world.bodies[i].mass.centre_O);
  }
  return state;
}

Pose poseOf(const Body& body, const BodyState& state) {
  Pose pose;
  pose.rotation = state.turned.toRotationMatrix();
  pose.origin = state.centre - pose.rotation * body.mass.centre_O;
  return pose;
}

Mat3 inertiaOf(const Body& body, const BodyState& state) {
  const Mat3 rotation = state.turned.toRotationMatrix();
  return rotation * body.mass.inertia_kg_m2 * rotation.transpose();
}

Mat3 inverseInertia(const Body& body, const BodyState& state) {
  const Mat3 rotation = state.turned.toRotationMatrix();
  return rotation * body.mass.inertia_kg_m2.inverse() * rotation.transpose();
}

std::uint64_t hashOf(const WorldState& state) {
  Hash hash;
  hash.add(state.steps);
  for (const BodyState& body : state.bodies) {
    hash.add(body.centre);
    for (int i = 0; i < 4; ++i) hash.add(body.turned.coeffs()[i]);
    hash.add(body.velocity);
    hash.add(body.spin);
    hash.add(static_cast<std::uint64_t>(body.stopped_short));
    hash.add(body.still_s);
    hash.add(body.island);
  }
  hash.add(state.memory);
  hash.add(state.asleep);
  return hash.value;
}

double kineticEnergy_J(const Body& body, const BodyState& state) {
  return (body.mass.mass_kg * state.velocity.squaredNorm() + state.spin.dot(inertiaOf(body, state) * state.spin)) / 2;
}

double kineticEnergy_J(const World& world, const WorldState& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) sum += kineticEnergy_J(world.bodies[i], state.bodies[i]);
  return sum;
}

double gravityEnergy_J(const World& world, const WorldState& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.bodies.size(); ++i)
    sum -= world.bodies[i].mass.mass_kg * world.gravity_m_s2.dot(state.bodies[i].centre);
  return sum;
}

}  // namespace hl
