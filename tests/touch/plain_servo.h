// Plain servo: a spring alone, for closed forms: without damping, friction, and limits that a test could meet.
#pragma once

#include "control/servo.h"
#include "device/device_models.h"

namespace hl::test {

inline ServoSettings plainServo(double stiffness_N_m, double period_s = 1e-3) {
  ServoSettings settings = ServoSettings::of(premium10().info);
  settings.stiffness_N_m = stiffness_N_m;
  settings.damping_Ns_m = 0;
  settings.ramp_s = settings.period_s = period_s;
  settings.friction_N = 0;
  settings.velocity_limit_m_s = 100;
  settings.force_rate_limit_N_s = 1e9;
  settings.ledger = LedgerMode::kReport;
  return settings;
}

}  // namespace hl::test
