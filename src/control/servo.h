// The servo step: from (state, target, device sample) to a force. PD to the target, under the state machine of
// safety.h. A pure function without threads: no allocation, lock, exception or system call.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "control/effects.h"
#include "control/hand_over.h"
#include "control/passivity_guard.h"
#include "control/remote_port.h"
#include "control/safety.h"
#include "control/servo_target.h"
#include "control/vibration_guard.h"
#include "device/device.h"

namespace hl {

struct SpringSettings {
  double stiffness_N_m = 0;
  double damping_Ns_m = 0;   ///< acts only while in contact (target off the finger): free air has no drag
  double force_limit_N = 0;  ///< this and the next change only while no force is made
  double force_rate_limit_N_s = 0;
  double friction_N = 0;  ///< of the device itself, a lower bound: what it dissipates pays for late hand-over
  LedgerMode ledger = LedgerMode::kTank;  ///< what late hand-over may add
  Effects effects{};
  PassivitySettings passivity{};
  VibrationSettings vibration{};
  RemoteInput remote{};
};

/// Members are in the bases alone, so that recordings see them all: base/fields.h.
struct ServoSettings : SafetySettings, SpringSettings {
  static ServoSettings of(const DeviceInfo& info);
};

struct SpringState {
  Vec3 force_N = Vec3::Zero();       ///< last output
  Vec3 velocity_m_s = Vec3::Zero();  ///< filtered
  Vec3 last_position = Vec3::Zero();
  std::array<Vec3, 2> before_D{Vec3::Zero(), Vec3::Zero()};  ///< the finger one and two steps before this one
  std::int64_t last_time_ns = 0;
  bool has_last = false;
  HandOverState spring;             ///< where the spring is fixed
  std::int64_t spring_time_ns = 0;  ///< of the target it was taken from
  PassivityGuard guard;
  VibrationGuard vibration;
  RemotePort remote;
};

/// Between steps; default-constructed it is off: arm() and disarm() of safety.h. Owned by the servo thread.
/// Members are in the bases alone, as those of ServoSettings.
struct ServoState : Safety, SpringState {};

struct ServoOutput {
  Vec3 force_N = Vec3::Zero();
  SafetyState safety = SafetyState::kOff;
  FaultReason fault = FaultReason::kNone;
};

/// One step. Whatever the inputs, the force is finite, within the limits of force and of its rate. RT-safe.
ServoOutput stepServo(ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                      const DeviceSample& sample) noexcept;

}  // namespace hl
