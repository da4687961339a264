// The servo step: from (state, target, device sample) to a force. PD to the target, and the safety state machine.
// A pure function without threads: no allocation, lock, exception or system call.
//
//   off --arm()--> arming --ramp done--> on        any --fault--> fault --arm()--> arming        any --disarm()--> off
// In off and fault the force is zero at once: a motor without current is the safe state, and a step down to zero is the
// one exception to the limit on the force rate.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "control/hand_over.h"
#include "device/device.h"

namespace hl {

enum class SafetyState : std::uint8_t { kOff, kArming, kOn, kFault };

enum class FaultReason : std::uint8_t {
  kNone,
  kDeviceLost,
  kBadPosition,
  kTooFast,
  kStaleTarget,
  kBadTarget,
  kNotReady,
  kDeadlines
};

/// One sentence for the user.
const char* faultText(FaultReason reason);

/// Where the servo pulls the finger: to target = finger + stiffness (proxy - finger), with the finger as it is at each
/// step. Device frame.
struct ServoTarget {
  Vec3 proxy_D = Vec3::Zero();
  std::int64_t time_ns = 0;  ///< when it was computed, on the clock of the samples
  bool valid = false;        ///< false: there is nothing to pull to; zero force, no fault
  double stiffness = 1;      ///< s of the surface, 0..1
  double paid_J = 0;         ///< energy that computing it has added, paid by the proxy's ledger
};

struct ServoSettings {
  double stiffness_N_m = 0;
  double damping_Ns_m = 0;  ///< acts only while in contact (target off the finger): free air has no drag
  double force_limit_N = 0;
  double force_rate_limit_N_s = 0;
  double velocity_limit_m_s = 0;
  double ramp_s = 0.5;    ///< arming: force grows from zero to full in this time
  double friction_N = 0;  ///< of the device itself, a lower bound: what it dissipates pays for late hand-over
  LedgerMode ledger = LedgerMode::kTank;  ///< what late hand-over may add
  double period_s = 1e-3;
  std::int64_t target_stale_ns = 50'000'000;    ///< an older target gives zero force
  std::int64_t target_lost_ns = 1'000'000'000;  ///< after so long it is a fault
  double missed_limit = 500;  ///< periods missed, one forgiven for every kForgiveSteps on time; more is a fault

  static constexpr double kForgiveSteps = 10;

  static ServoSettings of(const DeviceInfo& info);
};

/// Between steps; default-constructed it is off. Owned by the servo thread.
struct ServoState {
  SafetyState safety = SafetyState::kOff;
  FaultReason fault = FaultReason::kNone;
  double ramp = 0;                   ///< 0..1
  Vec3 force_N = Vec3::Zero();       ///< last output
  Vec3 velocity_m_s = Vec3::Zero();  ///< filtered
  Vec3 last_position = Vec3::Zero();
  std::array<Vec3, 2> before_D{Vec3::Zero(), Vec3::Zero()};  ///< the finger one and two steps before this one
  std::int64_t last_time_ns = 0;
  bool has_last = false;
  HandOverState spring;             ///< where the spring is fixed
  std::int64_t spring_time_ns = 0;  ///< of the target it was taken from
  double missed = 0;                ///< periods missed and not yet forgiven
};

struct ServoOutput {
  Vec3 force_N = Vec3::Zero();
  SafetyState safety = SafetyState::kOff;
  FaultReason fault = FaultReason::kNone;
};

/// Leaves off or fault; force starts from zero. Does nothing when armed already. RT-safe.
void arm(ServoState& state);
/// Zero force from the next step on. RT-safe.
void disarm(ServoState& state);

/// One step. Whatever the inputs, the force is finite, within the limits of force and of its rate. RT-safe.
ServoOutput stepServo(ServoState& state, const ServoSettings& settings, const ServoTarget& target,
                      const DeviceSample& sample) noexcept;

}  // namespace hl
