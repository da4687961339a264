// The safety states as docs/safety.md says them, written anew for the tests: it knows what was injected into a step,
// not how the servo finds it, and counts in whole steps.
#pragma once

#include <cstdint>

#include "control/safety.h"

namespace hl::test {

/// What was done to one step.
struct Injected {
  DeviceStatus status = DeviceStatus::kOk;
  bool position_is_number = true;
  bool blow = false;        ///< the finger has jumped a metre
  std::int64_t missed = 0;  ///< whole periods since the step before, less one
  bool target_is_number = true;
  bool target_lost = false;  ///< older than a second, or from the future
  bool held = true;          ///< the dead-man switch, or there is none
};

class SafetyModel {
 public:
  SafetyModel(double rate_Hz, double ramp_s, bool arm_again)
      : ramp_steps_(static_cast<std::int64_t>(ramp_s * rate_Hz + 0.5)),
        return_steps_(static_cast<std::int64_t>(0.5 * rate_Hz + 0.5)),
        blow_steps_(static_cast<std::int64_t>(0.002 * rate_Hz)),
        arm_again_(arm_again) {}

  void arm() {
    if (state_ == SafetyState::kOff || state_ == SafetyState::kFault) begin();
  }
  void disarm() { state_ = SafetyState::kOff, reason_ = FaultReason::kNone; }
  void stall() {
    if (state_ != SafetyState::kOff && state_ != SafetyState::kFault) fault(FaultReason::kStalled);
  }

  /// Whether a servo that was in the right state before may say this of the step. The moment at which counting in
  /// fractions reaches a limit, and a blow is found, is its own within bounds; the model then follows it.
  bool agrees(const Injected& in, SafetyState state, FaultReason reason) {
    if (state_ == SafetyState::kFault) returned(in);
    if (state_ == SafetyState::kOff || state_ == SafetyState::kFault) return state == state_ && reason == reason_;
    const bool readable = in.status == DeviceStatus::kOk && in.position_is_number;
    if (readable && watching_) tenths_ = in.missed > 0 ? tenths_ + 10 * in.missed : tenths_ > 0 ? tenths_ - 1 : 0;
    if (readable && watching_ && (in.blow || blow_age_ > 0)) ++blow_age_;
    watching_ = watching_ || readable;
    const FaultReason certain = certainFault(in);
    if (state == SafetyState::kFault && possible(reason, certain)) {
      fault(reason);
      return true;
    }
    if (certain != FaultReason::kNone) return false;
    advance(in.held);
    if (state_ == SafetyState::kArming && state == SafetyState::kOn && armed_steps_ >= ramp_steps_ - 1)
      state_ = SafetyState::kOn;
    return state == state_ && reason == FaultReason::kNone;
  }
  SafetyState state() const { return state_; }

 private:
  static constexpr std::int64_t kLimit_tenths = 5000;

  void begin() {
    state_ = SafetyState::kArming;
    reason_ = FaultReason::kNone;
    armed_steps_ = tenths_ = blow_age_ = 0;
    watching_ = false;
  }
  void fault(FaultReason reason) {
    state_ = SafetyState::kFault;
    reason_ = reason;
    well_ = 0;
  }
  void returned(const Injected& in) {
    if (reason_ != FaultReason::kDeviceLost && reason_ != FaultReason::kNotReady &&
        reason_ != FaultReason::kDeviceReturned)
      return;
    if (in.status == DeviceStatus::kLost) reason_ = FaultReason::kDeviceLost;
    if (in.status == DeviceStatus::kNotReady) reason_ = FaultReason::kNotReady;
    well_ = in.status == DeviceStatus::kOk && in.position_is_number ? well_ + 1 : 0;
    if (well_ < return_steps_) return;
    reason_ = FaultReason::kDeviceReturned;
    if (arm_again_) begin();
  }
  // In the order of docs/safety.md: the first one that holds is reported.
  FaultReason certainFault(const Injected& in) const {
    if (in.status == DeviceStatus::kLost) return FaultReason::kDeviceLost;
    if (in.status == DeviceStatus::kNotReady) return FaultReason::kNotReady;
    if (!in.position_is_number) return FaultReason::kBadPosition;
    if (blow_age_ >= blow_steps_) return FaultReason::kTooFast;
    if (tenths_ > kLimit_tenths + 1) return FaultReason::kDeadlines;
    if (!in.target_is_number) return FaultReason::kBadTarget;
    if (in.target_lost) return FaultReason::kStaleTarget;
    return FaultReason::kNone;
  }
  bool possible(FaultReason reason, FaultReason certain) const {
    if (reason == certain) return true;
    // Unless the device itself is away, a blow or the count may be found a step sooner than it must.
    const bool away = certain == FaultReason::kDeviceLost || certain == FaultReason::kNotReady ||
                      certain == FaultReason::kBadPosition;
    if (away) return false;
    if (reason == FaultReason::kTooFast) return blow_age_ > 0;
    return reason == FaultReason::kDeadlines && certain != FaultReason::kTooFast && tenths_ >= kLimit_tenths - 1;
  }
  void advance(bool held) {
    if (!held) {
      state_ = SafetyState::kWaiting;
      armed_steps_ = 0;
      return;
    }
    if (state_ == SafetyState::kWaiting) state_ = SafetyState::kArming;
    if (state_ == SafetyState::kArming && ++armed_steps_ > ramp_steps_) state_ = SafetyState::kOn;
  }

  const std::int64_t ramp_steps_, return_steps_, blow_steps_;
  const bool arm_again_;
  SafetyState state_ = SafetyState::kOff;
  FaultReason reason_ = FaultReason::kNone;
  std::int64_t armed_steps_ = 0, tenths_ = 0, well_ = 0, blow_age_ = 0;
  bool watching_ = false;
};

}  // namespace hl::test
