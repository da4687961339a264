// TouchStep: one servo step from encoder to motor, without a thread, a device or a clock: what hl touch, hl stability
// and the tests all run.
//
//   on time:  sample -> tick with this very sample -> target -> servo -> force
//   late:     sample -> the planes of the last tick that has come -> target -> servo -> force
#pragma once

#include <optional>

#include "control/servo.h"
#include "touch/held_contacts.h"
#include "touch/proxy_loop.h"

namespace hl {

/// What a tick within a servo step must know of it.
inline SpringOfServo springOf(const ServoSettings& settings, const Safety& safety) {
  return {settings.stiffness_N_m, settings.ledger, settings.period_s, makesForce(safety)};
}

/// Owned by the servo thread. RT-safe.
class TouchStep {
 public:
  /// Ticks now. `commands` and the rest of ProxyLoop::step are the caller's; a sample that is no reading ticks nothing.
  ServoOutput onTime(ProxyLoop& loop, const ProxyCommands& commands, const ServoSettings& settings,
                     const DeviceSample& sample);
  /// Another loop ticks; what it last found is `held`.
  ServoOutput late(const HeldContacts& held, const ServoSettings& settings, const DeviceSample& sample);

  ServoState& servo() { return servo_; }
  /// The target of the servo in the last step.
  const ServoTarget& target() const { return target_; }
  /// What the tick of the last step on time found; nothing: its sample was no reading.
  const std::optional<ProxyStep>& tick() const { return tick_; }

 private:
  ServoState servo_;
  ServoTarget target_;
  std::optional<ProxyStep> tick_;
};

}  // namespace hl
