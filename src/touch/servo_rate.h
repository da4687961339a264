// How many steps a second the servo makes: as a user says, as the device is used to, or as many as it takes and this
// machine holds.
#pragma once

#include <array>
#include <optional>

#include "base/function_ref.h"
#include "device/device.h"

namespace hl {

/// What a machine is tried at.
inline constexpr std::array kServoRates_Hz{1e3, 2e3, 4e3, 10e3};

/// The highest of kServoRates_Hz, and of the device's own rate, that is no more than the device takes and of which
/// `holds` says that the machine holds it; the device's own where it holds none. Setup only.
double highestServoRate_Hz(const DeviceInfo& device, FunctionRef<bool(double rate_Hz)> holds);

struct ServoRate {
  std::optional<double> given_Hz;
  bool highest = false;  ///< highestServoRate_Hz(), measured: a bare timer, a quarter of a second at each rate tried

  /// Setup only.
  double of(const DeviceInfo& device) const;
};

}  // namespace hl
