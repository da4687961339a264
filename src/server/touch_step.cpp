#include "server/touch_step.h"

namespace hl {

ServoOutput TouchStep::onTime(ProxyLoop& loop, const ProxyCommands& commands, const ServoSettings& settings,
                              const DeviceSample& sample) {
  if (sample.status == DeviceStatus::kOk && sample.position.allFinite()) {
    const SpringOfServo spring{settings.stiffness_N_m, settings.ledger, settings.period_s};
    tick_ = loop.step(sample.time_ns, sample.position, commands, spring);
  } else {
    tick_.held = HeldContacts{};
    tick_.held.target.time_ns = sample.time_ns;
  }
  target_ = tick_.held.target;
  return stepServo(servo_, settings, target_, sample);
}

ServoOutput TouchStep::late(const HeldContacts& held, const ServoSettings& settings, const DeviceSample& sample) {
  target_ = held.at(sample.position);
  return stepServo(servo_, settings, target_, sample);
}

}  // namespace hl
