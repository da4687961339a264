#include "control/safety.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"

namespace hl {

namespace {

bool readable(const DeviceSample& sample) { return sample.status == DeviceStatus::kOk && sample.position.allFinite(); }

void countMissed(Safety& safety, const SafetySettings& settings, const DeviceSample& sample) {
  const double missed = std::round(age_s(sample.time_ns, safety.watched_ns) / settings.period_s) - 1;
  safety.missed = std::max(0.0, safety.missed + (missed > 0 ? missed : -1 / SafetySettings::kForgiveSteps));
}

// When the tip was where the sample says.
std::int64_t taken_ns(const DeviceSample& sample) { return wrappedDifference_ns(sample.time_ns, sample.age_ns); }

void measureSpeed(Safety& safety, const DeviceSample& sample) {
  const double window_s = age_s(taken_ns(sample), safety.mark_ns);
  if (window_s >= 0 && window_s < seconds(SafetySettings::kSpeedWindow_ns)) return;
  // A clock that went back gives no speed: a new window begins.
  safety.speed_m_s = window_s > 0 ? (sample.position - safety.mark_D).norm() / window_s : 0;
  safety.mark_D = sample.position;
  safety.mark_ns = taken_ns(sample);
}

void watch(Safety& safety, const SafetySettings& settings, const DeviceSample& sample) {
  if (!readable(sample)) return;
  if (safety.watching) {
    countMissed(safety, settings, sample);
    measureSpeed(safety, sample);
  } else {
    safety.mark_D = sample.position;
    safety.mark_ns = taken_ns(sample);
  }
  safety.watched_ns = sample.time_ns;
  safety.watching = true;
}

FaultReason judge(const Safety& safety, const SafetySettings& settings, const ServoTarget& target,
                  const DeviceSample& sample) {
  if (sample.status == DeviceStatus::kLost) return FaultReason::kDeviceLost;
  if (sample.status == DeviceStatus::kNotReady) return FaultReason::kNotReady;
  if (!sample.position.allFinite()) return FaultReason::kBadPosition;
  if (!(safety.speed_m_s <= settings.velocity_limit_m_s)) return FaultReason::kTooFast;  // NaN too
  if (safety.missed > settings.missed_limit) return FaultReason::kDeadlines;
  if (target.valid && !(target.proxy_D.allFinite() && std::isfinite(target.stiffness))) return FaultReason::kBadTarget;
  // A target from the future is as wrong as one from long ago.
  if (target.time_ns != 0 && std::abs(age_s(sample.time_ns, target.time_ns)) > seconds(settings.target_lost_ns))
    return FaultReason::kStaleTarget;
  return FaultReason::kNone;
}

bool isHeld(const SafetySettings& settings, const DeviceSample& sample) {
  switch (settings.dead_man) {
    case DeadMan::kNone:
      return true;
    case DeadMan::kButton:
      return settings.dead_man_button < 32 && (sample.buttons >> settings.dead_man_button & 1U) != 0;
    case DeadMan::kHeld:
      return sample.held;
  }
  return false;
}

void beginArming(Safety& safety) {
  safety = Safety{};
  safety.safety = SafetyState::kArming;
}

bool deviceWasAway(FaultReason reason) {
  return reason == FaultReason::kDeviceLost || reason == FaultReason::kNotReady ||
         reason == FaultReason::kDeviceReturned;
}

// In fault: reports when a device that was away has returned, and arms again where that is wanted.
void awaitReturn(Safety& safety, const SafetySettings& settings, const DeviceSample& sample) {
  if (!deviceWasAway(safety.fault)) return;
  if (sample.status != DeviceStatus::kOk)
    safety.fault = sample.status == DeviceStatus::kLost ? FaultReason::kDeviceLost : FaultReason::kNotReady;
  safety.well_steps = readable(sample) ? safety.well_steps + 1 : 0;
  if (safety.well_steps * settings.period_s < SafetySettings::kReturn_s) return;
  safety.fault = FaultReason::kDeviceReturned;
  if (settings.arm_again) beginArming(safety);
}

void followDeadMan(Safety& safety, bool held) {
  if (!held) {
    safety.safety = SafetyState::kWaiting;
    safety.ramp = 0;
  } else if (safety.safety == SafetyState::kWaiting) {
    safety.safety = SafetyState::kArming;
  }
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
    case FaultReason::kStalled:
      return "the servo stood still: the device or the machine held it up";
    case FaultReason::kDeviceReturned:
      return "the device was away and is back: arm again";
    case FaultReason::kOtherDevice:
      return "another device is in fault, and they stop together";
  }
  return "";
}

void arm(Safety& safety) {
  // Armed already: starting again from zero would drop the force at once, beyond the limit of its rate.
  if (!isArmed(safety)) beginArming(safety);
}

void disarm(Safety& safety) { safety = Safety{}; }

void fail(Safety& safety, FaultReason reason) {
  if (!isArmed(safety)) return;
  safety.safety = SafetyState::kFault;
  safety.fault = reason;
  safety.ramp = 0;
  safety.well_steps = 0;
}

double stepSafety(Safety& safety, const SafetySettings& settings, const ServoTarget& target,
                  const DeviceSample& sample) noexcept {
  watch(safety, settings, sample);
  if (safety.safety == SafetyState::kFault) awaitReturn(safety, settings, sample);
  if (!isArmed(safety)) return 0;
  if (const FaultReason reason = judge(safety, settings, target, sample); reason != FaultReason::kNone) {
    fail(safety, reason);
    return 0;
  }
  followDeadMan(safety, isHeld(settings, sample));
  if (safety.safety == SafetyState::kArming) {
    safety.ramp = std::min(1.0, safety.ramp + settings.period_s / settings.ramp_s);
    if (safety.ramp >= 1) safety.safety = SafetyState::kOn;
  }
  return safety.ramp;
}

}  // namespace hl
