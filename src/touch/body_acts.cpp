#include "touch/body_acts.h"

#include <algorithm>

#include "bodies/sleep.h"

namespace hl {

namespace {

// However light the body is, it is not made faster than bodies may be.
void give(const MovingBodies& moving, std::size_t i, const Vec3& impulse_N_s, const Vec3& point) {
  const Body& body = moving.world.bodies[i];
  BodyState& state = moving.state.bodies[i];
  state.velocity = limited(state.velocity + impulse_N_s / body.mass.mass_kg, kFastest_m_s);
  state.spin =
      limited(state.spin + inverseInertia(body, state) * (point - state.centre).cross(impulse_N_s), kFastest_rad_s);
}

void place(const MovingBodies& moving, std::size_t i, const BodyCommand& command) {
  const Body& body = moving.world.bodies[i];
  BodyState& state = moving.state.bodies[i];
  Pose pose = poseOf(body, state);
  if (command.position_m) pose.origin = *command.position_m;
  if (command.rotation) state.turned = Eigen::Quaterniond(*command.rotation).normalized();
  pose.rotation = state.turned.toRotationMatrix();
  state.centre = pose.toWorld(body.mass.centre_O);
  moving.bodies[i]->poses->jumpTo(moving.shown(i));
}

// Wakes the body, and books in `account` the energy that `change` brings.
template <typename Change>
void booked(const MovingBodies& moving, std::size_t i, double& account_J, Change change) {
  const double before_J = moving.energy_J(i);
  wake(moving.world, moving.state, moving.world.bodies[i].key);
  change();
  account_J += moving.energy_J(i) - before_J;
}

}  // namespace

ShownBody MovingBodies::shown(std::size_t i) const {
  const BodyState& body = state.bodies[i];
  return {poseOf(world.bodies[i], body), body.velocity, body.spin};
}

double MovingBodies::energy_J(std::size_t i) const {
  const Body& body = world.bodies[i];
  return kineticEnergy_J(body, state.bodies[i]) - body.mass.mass_kg * world.gravity_m_s2.dot(state.bodies[i].centre);
}

void act(const MovingBodies& moving, const BodyCommand& command, BodyPushes& pushes) {
  const std::size_t i = moving.world.numberOf(command.key);
  if (i == World::kNoBody) return;
  BodyState& state = moving.state.bodies[i];
  booked(moving, i, moving.state.energy.by_client_J, [&] {
    if (command.position_m || command.rotation) place(moving, i, command);
    if (command.velocity_m_s) state.velocity = *command.velocity_m_s;
    if (command.spin_rad_s) state.spin = *command.spin_rad_s;
    const Vec3 point = command.point_m.value_or(state.centre);
    BodyPush over_time{command.key, poseOf(moving.world.bodies[i], state).toObject(point), command.impulse_N_s,
                       command.duration_s};
    if (command.duration_s > 0) over_time.force_N /= command.duration_s;
    // Of more than there is room for, the whole is given at once.
    if (!(command.duration_s > 0) || !pushes.push(over_time)) give(moving, i, command.impulse_N_s, point);
  });
}

void push(const MovingBodies& moving, BodyPushes& pushes, double period_s) {
  std::size_t kept = 0;
  for (const BodyPush& one : pushes) {
    const std::size_t i = moving.world.numberOf(one.key);
    if (i == World::kNoBody) continue;
    booked(moving, i, moving.state.energy.by_client_J, [&] {
      const Vec3 point = poseOf(moving.world.bodies[i], moving.state.bodies[i]).toWorld(one.point_O);
      give(moving, i, std::min(period_s, one.left_s) * one.force_N, point);
    });
    BodyPush left = one;
    left.left_s -= period_s;
    if (left.left_s > 0) pushes[kept++] = left;
  }
  pushes.resize(kept);
}

void giveByHand(const MovingBodies& moving, const BodyImpulse& one) {
  const std::size_t i = moving.world.numberOf(one.key);
  if (i == World::kNoBody) return;
  booked(moving, i, moving.state.energy.by_hand_J, [&] { give(moving, i, one.impulse_N_s, one.point); });
}

}  // namespace hl
