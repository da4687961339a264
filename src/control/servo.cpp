#include "control/servo.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// First-order low-pass on the finite difference of the encoders; below it 30 um counts at 1 kHz are 30 mm/s of noise.
constexpr double kVelocityCutoff_Hz = 60;

ServoOutput output(const ServoState& state) { return {state.force_N, state.safety, state.fault}; }

// In double: times from a broken device cannot overflow.
double age_s(std::int64_t now_ns, std::int64_t then_ns) {
  return 1e-9 * (static_cast<double>(now_ns) - static_cast<double>(then_ns));
}

void fail(ServoState& state, FaultReason reason) {
  state.safety = SafetyState::kFault;
  state.fault = reason;
  state.ramp = 0;
}

FaultReason judge(const ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                  const DeviceSample& sample) {
  if (sample.status == DeviceStatus::kLost) return FaultReason::kDeviceLost;
  if (sample.status == DeviceStatus::kNotReady) return FaultReason::kNotReady;
  if (!sample.position.allFinite()) return FaultReason::kBadPosition;
  if (!(state.velocity_m_s.norm() <= settings.velocity_limit_m_s)) return FaultReason::kTooFast;  // NaN too
  if (state.missed > settings.missed_limit) return FaultReason::kDeadlines;
  if (target.valid && !(target.proxy_D.allFinite() && std::isfinite(target.stiffness))) return FaultReason::kBadTarget;
  if (target.time_ns != 0 &&
      age_s(sample.time_ns, target.time_ns) > 1e-9 * static_cast<double>(settings.target_lost_ns))
    return FaultReason::kStaleTarget;
  return FaultReason::kNone;
}

// Before updateVelocity(), which moves the last time on.
void countMissed(ServoState& state, const ServoSettings& settings, const DeviceSample& sample) {
  if (!state.has_last) return;
  const double missed = std::round(age_s(sample.time_ns, state.last_time_ns) / settings.period_s) - 1;
  state.missed = std::max(0.0, state.missed + (missed > 0 ? missed : -1 / ServoSettings::kForgiveSteps));
}

void updateVelocity(ServoState& state, const DeviceSample& sample) {
  const double dt = age_s(sample.time_ns, state.last_time_ns);
  if (state.has_last && dt > 0) {
    const double blend = 1 - std::exp(-2 * M_PI * kVelocityCutoff_Hz * dt);
    state.velocity_m_s += blend * ((sample.position - state.last_position) / dt - state.velocity_m_s);
  }
  state.before_D[1] = state.has_last ? state.before_D[0] : sample.position;
  state.before_D[0] = state.has_last ? state.last_position : sample.position;
  state.last_position = sample.position;
  state.last_time_ns = sample.time_ns;
  state.has_last = true;
}

bool usable(const ServoSettings& settings, const ServoTarget& target, const DeviceSample& sample) {
  return target.valid && target.stiffness >= 0 && target.stiffness <= 1 &&
         age_s(sample.time_ns, target.time_ns) <= 1e-9 * static_cast<double>(settings.target_stale_ns);
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
  handOver(state.spring, settings.ledger, settings.stiffness_N_m, {target.proxy_D, target.stiffness}, paid_J,
           state.before_D[1], sample.position);
  const Vec3 gap = state.spring.end.stiffness * (state.spring.end.proxy_D - sample.position);
  if (gap.isZero(0)) return Vec3::Zero();
  return settings.stiffness_N_m * gap - settings.damping_Ns_m * state.velocity_m_s;
}

}  // namespace

const char* faultText(FaultReason reason) {
  switch (reason) {
    case FaultReason::kNone:
      return "";
    case FaultReason::kDeviceLost:
      return "the device does not answer: check its cable and power";
    case FaultReason::kBadPosition:
      return "the device reports a position that is not a number";
    case FaultReason::kTooFast:
      return "the hand moved faster than the device allows";
    case FaultReason::kStaleTarget:
      return "the proxy loop has stopped";
    case FaultReason::kBadTarget:
      return "the proxy loop gave a position that is not a number";
    case FaultReason::kNotReady:
      return "the device is not ready";
    case FaultReason::kDeadlines:
      return "the servo was late too often: the machine is too busy";
  }
  return "";
}

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

void arm(ServoState& state) {
  // Armed already: starting again from zero would drop the force at once, beyond the limit of its rate.
  if (state.safety == SafetyState::kArming || state.safety == SafetyState::kOn) return;
  state = ServoState{};
  state.safety = SafetyState::kArming;
}

void disarm(ServoState& state) { state = ServoState{}; }

ServoOutput stepServo(ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                      const DeviceSample& sample) noexcept {
  const bool readable = sample.status == DeviceStatus::kOk && sample.position.allFinite();
  if (readable) {
    countMissed(state, settings, sample);
    updateVelocity(state, sample);
  }
  if (state.safety == SafetyState::kArming || state.safety == SafetyState::kOn) {
    const FaultReason reason = judge(state, settings, target, sample);
    if (reason != FaultReason::kNone) fail(state, reason);
  }
  if (state.safety == SafetyState::kOff || state.safety == SafetyState::kFault) {
    state.force_N = Vec3::Zero();
    return output(state);
  }
  if (state.safety == SafetyState::kArming) {
    state.ramp = std::min(1.0, state.ramp + settings.period_s / settings.ramp_s);
    if (state.ramp >= 1) state.safety = SafetyState::kOn;
  }
  Vec3 wanted = limited(state.ramp * wantedForce(state, settings, target, sample), settings.force_limit_N);
  if (!wanted.allFinite()) wanted = Vec3::Zero();
  // A change within the rate limit keeps the force inside the ball of the force limit: both ends are in it.
  state.force_N += limited(wanted - state.force_N, settings.force_rate_limit_N_s * settings.period_s);
  return output(state);
}

}  // namespace hl
