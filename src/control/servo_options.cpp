#include "control/servo_options.h"

#include <algorithm>

namespace hl {

void ServoOptions::apply(ServoSettings& settings) const {
  const auto lower = [](double& limit, const std::optional<double>& wanted) {
    if (wanted) limit = std::min(limit, *wanted);
  };
  lower(settings.force_limit_N, force_limit_N);
  lower(settings.velocity_limit_m_s, speed_limit_m_s);
  settings.dead_man = dead_man;
  settings.dead_man_button = dead_man_button;
  settings.arm_again = arm_again;
  settings.effects = effects;
  settings.passivity = passivity;
  settings.vibration = vibration;
}

}  // namespace hl
