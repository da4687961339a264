// The devices that can be simulated, each a set of parameters with its sources.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "device/arm.h"
#include "device/device.h"
#include "device/mass_arm.h"
#include "device/phantom.h"
#include "device/wrist.h"

namespace hl {

struct DeviceModel {
  std::string_view name;  ///< as in --device sim:NAME
  DeviceInfo info;
  std::variant<PhantomParameters, MassParameters> arm;
  WristParameters wrist{};
};

DeviceModel premium10();
DeviceModel premium15();
DeviceModel touchDevice();
DeviceModel falcon();
DeviceModel omega3();
DeviceModel omega7();

/// One mass with a viscous damper and nothing else: no friction, no encoder steps, no DAC; the theory's device.
DeviceModel linearDevice(double mass_kg, double damping_Ns_m);

/// All real ones, the default first.
std::array<DeviceModel, 6> deviceModels();
/// Their names, with commas.
std::string simulatedModelNames();
/// Throws hl::Error with the names there are.
DeviceModel deviceModel(std::string_view name);

std::unique_ptr<Arm> makeArm(const DeviceModel& model, double current_lag_s);

}  // namespace hl
