#include "touch/touch_step.h"

namespace hl {

ServoOutput TouchStep::onTime(ProxyLoop& loop, const ProxyCommands& commands, const ServoSettings& settings,
                              const DeviceSample& sample) {
  if (sample.status == DeviceStatus::kOk && sample.position.allFinite()) {
    tick_ = loop.step(sample.time_ns, sample.position, commands, springOf(settings, servo_));
    target_ = tick_->held.target;
  } else {
    loop.skip();
    tick_.reset();
    target_ = ServoTarget{};
    target_.time_ns = sample.time_ns;
  }
  return stepServo(servo_, settings, target_, sample);
}

ServoOutput TouchStep::late(const HeldContacts& held, const ServoSettings& settings, const DeviceSample& sample) {
  target_ = held.at(sample.position);
  return stepServo(servo_, settings, target_, sample);
}

}  // namespace hl
