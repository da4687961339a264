// Safety: the state machine that decides whether the servo may make force, and how much of it. Drawn and explained in
// docs/safety.md. A pure function of what one step sees: no allocation, lock, exception or system call.
//
//   off --arm--> arming --ramp done--> on
//   arming, on, waiting --fault--> fault --arm--> arming
//   arming, on --dead-man let go--> waiting --held--> arming
//   any --disarm--> off
//
// In off, fault and waiting the force is zero at once: a motor without current is the safe state, and a step down to
// zero is the one exception to the limit on the force rate.
#pragma once

#include <cstdint>
#include <limits>

#include "base/vec.h"
#include "control/servo_target.h"
#include "device/device.h"

namespace hl {

enum class SafetyState : std::uint8_t {
  kOff,
  kArming,  ///< force ramps up from zero
  kOn,
  kFault,
  kWaiting  ///< armed, but nobody holds the dead-man switch
};

enum class FaultReason : std::uint8_t {
  kNone,
  kDeviceLost,
  kBadPosition,
  kTooFast,
  kStaleTarget,
  kBadTarget,
  kNotReady,
  kDeadlines,
  kStalled,         ///< the watchdog found the servo standing still
  kDeviceReturned,  ///< it was lost or not ready, and has been well since
  kOtherDevice      ///< another device is in fault, and their faults are joined
};

/// One sentence for the user.
const char* faultText(FaultReason reason);

/// What has to be held for force to be made.
enum class DeadMan : std::uint8_t {
  kNone,
  kButton,  ///< a button of the device
  kHeld     ///< the device, where it can report this
};

struct SafetySettings {
  double period_s = 1e-3;
  double velocity_limit_m_s = 0;
  double ramp_s = 0.5;                          ///< arming: force grows from zero to full in this time
  std::int64_t target_stale_ns = 50'000'000;    ///< an older target gives zero force
  std::int64_t target_lost_ns = 1'000'000'000;  ///< after so long it is a fault
  /// Periods missed, one forgiven for every kForgiveSteps on time; more is a fault.
  double missed_limit = 500;
  DeadMan dead_man = DeadMan::kNone;
  std::uint32_t dead_man_button = 0;  ///< 0..31
  bool arm_again = false;             ///< by itself, when a lost device has returned

  static constexpr double kForgiveSteps = 10;
  static constexpr double kNoLimit = std::numeric_limits<double>::max();
  /// A device that was lost is back when it has been well for so long without a break.
  static constexpr double kReturn_s = 0.5;
  /// Speed is judged over this time at the least: shorter, one count of an encoder looks like a blow. Two of them are
  /// less than the 2 ms in which every fault has to be found.
  static constexpr std::int64_t kSpeedWindow_ns = 800'000;
};

/// Between steps; default-constructed it is off. Owned by the servo thread.
struct Safety {
  SafetyState safety = SafetyState::kOff;
  FaultReason fault = FaultReason::kNone;
  double ramp = 0;               ///< 0..1
  double missed = 0;             ///< periods missed and not yet forgiven
  std::uint32_t well_steps = 0;  ///< in fault: how many in a row the device has answered since
  bool watching = false;
  std::int64_t watched_ns = 0;  ///< time of the last good sample, when watching
  Vec3 mark_D = Vec3::Zero();   ///< where and when the window of speed began
  std::int64_t mark_ns = 0;
  double speed_m_s = 0;  ///< mean over the last window
};

/// Arming, on or waiting: a fault would change the state.
inline bool isArmed(const Safety& safety) {
  return safety.safety != SafetyState::kOff && safety.safety != SafetyState::kFault;
}

/// Arming or on: what the spring does is felt.
inline bool makesForce(const Safety& safety) {
  return safety.safety == SafetyState::kArming || safety.safety == SafetyState::kOn;
}

/// Leaves off or fault; force starts from zero. Does nothing when armed already. RT-safe.
void arm(Safety& safety);
/// Zero force from the next step on. RT-safe.
void disarm(Safety& safety);
/// A fault found elsewhere; does nothing unless armed. RT-safe.
void fail(Safety& safety, FaultReason reason);

/// One step. Returns the part of the wanted force that may be made: 0 at once in off, fault and waiting. RT-safe.
double stepSafety(Safety& safety, const SafetySettings& settings, const ServoTarget& target,
                  const DeviceSample& sample) noexcept;

}  // namespace hl
