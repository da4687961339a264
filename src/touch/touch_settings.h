// Settings of a touch session, fixed when it begins.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/ledger.h"
#include "control/servo_options.h"
#include "device/hand_script.h"
#include "scene/material.h"
#include "touch/fault_group.h"
#include "touch/servo_rate.h"
#include "touch/step_sink.h"

namespace hl {

class HandGroup;

struct TouchSettings {
  DeviceLabel label;
  std::shared_ptr<HandGroup> hands;    ///< of all devices that touch one world of bodies; null: this one alone
  std::shared_ptr<FaultGroup> faults;  ///< of all devices that stop together; null: this one alone
  double radius_D = 0.002;             ///< m, proxy radius at the hand
  double side_D = 0.12;  ///< m, largest side of the model at the hand, unless scale is given; at most what the device
                         ///< reaches
  std::optional<double> world_per_device;
  ServoRate servo_rate{};
  double proxy_rate_Hz = 1000;          ///< while ticks do not fit in a servo step
  std::optional<double> stiffness_N_m;  ///< K; the device's own when not given
  std::optional<double> damping_Ns_m;   ///< B
  ServoOptions servo{};
  MakeStepSink sink;       ///< of all that the loops do; empty: none
  bool hand_firm = false;  ///< of a simulated hand, as the next two
  bool explore = true;
  std::optional<HandScript> script;  ///< hand goals in the world frame instead of exploration
  MaterialOverride surfaces{};       ///< over what the scene says
  LedgerMode ledger = LedgerMode::kTank;
  bool timer_reference = false;  ///< run a bare timer thread on the servo's core, to measure the machine's own delays
};

}  // namespace hl
