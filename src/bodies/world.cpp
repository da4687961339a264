#include "bodies/world.h"

#include "bodies/joint_check.h"
#include "bodies/joint_place.h"

namespace hl {

void checkWorld(const World& world) {
  checkJoints(world.joints, [&](std::uint64_t key) { return world.has(key); });
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
    const std::size_t body = world.numberOf(key);
    return body == World::kNoBody ? Pose() : poses[body];
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
