// Stability case: a device, and the loop that it is in.
#pragma once

#include "device/simulated_device.h"

namespace hl {

/// One loop.
struct StabilityCase {
  SimulatedDeviceSettings device;  ///< with grip, delay and whatever else is wrong with it
  double rate_Hz = 1000;
  double damping_Ns_m = 0;  ///< B of the servo
};

}  // namespace hl
