#include "touch/servo_rate.h"

#include <chrono>

#include "base/timer_probe.h"

namespace hl {

double highestServoRate_Hz(const DeviceInfo& device, FunctionRef<bool(double)> holds) {
  for (auto rate = kServoRates_Hz.rbegin(); rate != kServoRates_Hz.rend(); ++rate) {
    if (*rate <= device.servo_rate_Hz) break;
    if (*rate <= device.servo_rate_max_Hz && holds(*rate)) return *rate;
  }
  return device.servo_rate_Hz;
}

double ServoRate::of(const DeviceInfo& device) const {
  if (given_Hz) return *given_Hz;
  if (!highest) return device.servo_rate_Hz;
  return highestServoRate_Hz(device, [](double rate_Hz) {
    TimerProbe probe;
    probe.rate_Hz = rate_Hz;
    probe.run(std::chrono::milliseconds(250));
    return probe.holds();
  });
}

}  // namespace hl
