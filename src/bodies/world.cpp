#include "bodies/world.h"

#include <bit>

#include "bodies/joint_check.h"
#include "bodies/joint_place.h"

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
  void add(const JointState& joint) {
    add(joint.coordinate);
    add(joint.velocity);
    for (const double impulse : joint.held) add(impulse);
    for (const double impulse : joint.along) add(impulse);
    add(joint.spare_J);
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

void checkWorld(const World& world) {
  checkJoints(world.joints, [&](std::uint64_t key) { return world.find(key) != nullptr; });
}

WorldState startWorld(const World& world, const std::vector<Pose>& poses) {
  checkWorld(world);
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
  const auto pose = [&](std::uint64_t key) {
    const Body* const body = world.find(key);
    return body == nullptr ? Pose() : poses[static_cast<std::size_t>(body - world.bodies.data())];
  };
  for (const Joint& joint : world.joints) {
    JointState one;
    one.coordinate = JointPlace(joint, pose(joint.body_a), pose(joint.body_b)).coordinate(0);
    state.joints.push_back(one);
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
  for (const JointState& joint : state.joints) hash.add(joint);
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

double springEnergy_J(const World& world, const WorldState& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.joints.size(); ++i)
    sum += springEnergy_J(world.joints[i], state.joints[i].coordinate);
  return sum;
}

}  // namespace hl
