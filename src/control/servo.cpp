#include "control/servo.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "base/plain_math.h"

namespace hl {

namespace {

// First-order low-pass on the finite difference of the encoders; below it 30 um counts at 1 kHz are 30 mm/s of noise.
constexpr double kVelocityCutoff_Hz = 60;

ServoOutput output(const ServoState& state) { return {state.force_N, state.safety, state.fault}; }

void updateVelocity(ServoState& state, const DeviceSample& sample) {
  const double dt = age_s(sample.time_ns, state.last_time_ns);
  if (state.has_last && dt > 0) {
    const double blend = 1 - plain::expOfNegative(-2 * M_PI * kVelocityCutoff_Hz * dt);
    state.velocity_m_s += blend * ((sample.position - state.last_position) / dt - state.velocity_m_s);
  }
  state.before_D[1] = state.has_last ? state.before_D[0] : sample.position;
  state.before_D[0] = state.has_last ? state.last_position : sample.position;
  state.last_position = sample.position;
  state.last_time_ns = sample.time_ns;
  state.has_last = true;
}

// Without force nothing is remembered of how the finger moved: what arms next begins with what it sees.
void rest(ServoState& state) {
  state.force_N = state.velocity_m_s = state.guard.held_N = Vec3::Zero();
  state.spring.pulling = state.has_last = false;
  restVibration(state.vibration);
  restRemote(state.remote);
}

bool isFresh(const ServoSettings& settings, const ServoTarget& target, const DeviceSample& sample) {
  return std::abs(age_s(sample.time_ns, target.time_ns)) <= seconds(settings.target_stale_ns);
}

bool usable(const ServoSettings& settings, const ServoTarget& target, const DeviceSample& sample) {
  return target.valid && target.stiffness >= 0 && target.stiffness <= 1 && isFresh(settings, target, sample);
}

// Of the scene's fields; none of a target that cannot be trusted.
Vec3 fieldForce(const ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                const DeviceSample& sample) {
  if (!isFresh(settings, target, sample)) return Vec3::Zero();
  return target.field_N - target.field_drag_Ns_m * state.velocity_m_s;
}

// The spring and damper, or zero when the target cannot be trusted.
Vec3 wantedForce(ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                 const DeviceSample& sample) {
  refillFromFriction(state.spring, settings.friction_N, state.before_D[0], sample.position);
  if (!usable(settings, target, sample)) {
    state.spring.pulling = false;
    return Vec3::Zero();
  }
  const double paid_J = target.time_ns != state.spring_time_ns ? target.paid_J : 0;
  state.spring_time_ns = target.time_ns;
  const double stiffness_N_m = limitedStiffness_N_m(state.vibration, settings.stiffness_N_m, target.stiffness);
  handOver(state.spring, settings.ledger, stiffness_N_m, {target.proxy_D, target.stiffness}, paid_J, state.before_D[1],
           sample.position);
  const Vec3 gap = state.spring.end.stiffness * (state.spring.end.proxy_D - sample.position);
  if (gap.isZero(0)) return Vec3::Zero();
  return stiffness_N_m * gap - (settings.damping_Ns_m + state.vibration.damping_Ns_m) * state.velocity_m_s;
}

// What the vibration guard sees of this step.
void lookForVibration(ServoState& state, const ServoSettings& settings, const Vec3& spring_N, const Vec3& finger_D) {
  const SpringEnd& end = state.spring.end;
  SpringStep step;
  step.finger_D = finger_D;
  step.pulling = state.spring.pulling;
  if (step.pulling) {
    step.stiffness_N_m = end.stiffness * limitedStiffness_N_m(state.vibration, settings.stiffness_N_m, end.stiffness);
    step.gap = end.proxy_D - finger_D;
    step.force_N = limited(spring_N, settings.force_limit_N);
  }
  watchVibration(state.vibration, settings.vibration, step, settings.stiffness_N_m, state.velocity_m_s,
                 settings.period_s);
}

// Goes on from `force_N` toward `wanted_N` within the limits. A change within the limit of the rate keeps the force
// inside the ball of the limit of force: both ends are in it.
Vec3 within(const ServoSettings& settings, const Vec3& force_N, const Vec3& wanted_N) {
  const Vec3 wanted = wanted_N.allFinite() ? limited(wanted_N, settings.force_limit_N) : Vec3(Vec3::Zero());
  return force_N + limited(wanted - force_N, settings.force_rate_limit_N_s * settings.period_s);
}

// With what the robot far away adds: the difference to the force that would have been made without it, limits and all.
// Gives that one.
Vec3 makeForce(ServoState& state, const ServoSettings& settings, const Vec3& wanted_N, double part,
               const DeviceSample& sample) {
  const Vec3 local_N = within(settings, state.force_N - state.remote.held_N, wanted_N);
  const RemoteStep step{sample.time_ns, settings.period_s, sample.position - state.before_D[0], state.velocity_m_s,
                        local_N};
  const Vec3 added_N =
      settings.remote.on ? Vec3(part * remoteForce(state.remote, settings.remote, step)) : Vec3(Vec3::Zero());
  state.force_N = within(settings, state.force_N, wanted_N + added_N);
  state.remote.held_N = state.force_N - local_N;
  return local_N;
}

}  // namespace

ServoSettings ServoSettings::of(const DeviceInfo& info) {
  ServoSettings settings;
  settings.stiffness_N_m = info.stiffness_N_m;
  settings.damping_Ns_m = info.damping_Ns_m;
  settings.force_limit_N = info.force_max_N;
  settings.force_rate_limit_N_s = info.force_rate_max_N_s;
  settings.velocity_limit_m_s = info.velocity_max_m_s;
  settings.period_s = 1 / info.servo_rate_Hz;
  settings.friction_N = info.friction_N;
  return settings;
}

ServoOutput stepServo(ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                      const DeviceSample& sample) noexcept {
  const double part = stepSafety(state, settings, target, sample);
  if (part == 0) {
    rest(state);
    return output(state);
  }
  updateVelocity(state, sample);
  Vec3 spring_N = wantedForce(state, settings, target, sample);
  const bool touching = state.spring.pulling;
  lookForVibration(state, settings, spring_N, sample.position);
  Vec3 effects_N = part * (effectForce(settings.effects, sample, state.velocity_m_s, touching) +
                           fieldForce(state, settings, target, sample));
  effects_N = effects_N.allFinite() ? limited(effects_N, settings.force_limit_N) : Vec3(Vec3::Zero());
  if (settings.passivity.on)
    spring_N = dampedToPassive(state.guard, settings.passivity, spring_N, sample.position - state.before_D[0], touching,
                               settings.period_s);
  const Vec3 local_N = makeForce(state, settings, part * spring_N + effects_N, part, sample);
  state.guard.held_N = local_N - effects_N;
  return output(state);
}

}  // namespace hl
