// ServoOptions: what a user asks of the servo, over what the device says of itself.
#pragma once

#include <cstdint>
#include <optional>

#include "control/servo.h"

namespace hl {

struct ServoOptions {
  std::optional<double> force_limit_N;    ///< never above the device's own
  std::optional<double> speed_limit_m_s;  ///< faster is a fault; never above the device's own
  DeadMan dead_man = DeadMan::kNone;
  std::uint32_t dead_man_button = 0;
  bool arm_again = false;
  Effects effects{};
  PassivitySettings passivity{};
  VibrationSettings vibration{};

  void apply(ServoSettings& settings) const;
};

}  // namespace hl
