#include "device_options.h"

#include "base/error.h"
#include "choice_option.h"
#include "record/replay_device.h"
#include "session/touch_world.h"

namespace hl {

namespace {

constexpr const char* kDeviceGroup = "Device";

std::string faultOfDevice(const std::string& text) {
  try {
    makeAnyDevice(parseNamedDevice(text).spec);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

void addDeviceOptions(CLI::App& command, DeviceOptions& options) {
  command
      .add_option("--device", options.given,
                  "a haptic device, once for each hand, with a name for each where there are several (default names: "
                  "left, right; of more device0, device1, ...); hl doctor tells which are present")
      ->check(CLI::Validator(faultOfDevice, ""))
      ->allow_extra_args(false)
      ->option_text("[NAME=]" + anyDeviceSpecs() + " (default: sim)")
      ->group(kDeviceGroup);
  addChoice(command, "--faults", options.faults_joined, {{"apart", false}, {"joined", true}},
            "apart: a device in fault leaves the others as they are; joined: none makes force while one is in "
            "fault, and to arm one is to arm all")
      ->group(kDeviceGroup);
}

void addSimulatedDevicesOption(CLI::App& command, DeviceOptions& options) {
  command.add_option("--devices", options.simulated, "that many simulated devices, in the place of --device")
      ->check(CLI::Range(std::size_t{1}, TouchServerSettings::kMaxDevices))
      ->option_text("1..16")
      ->group(kDeviceGroup);
}

std::vector<NamedDevice> devicesOf(const DeviceOptions& options) {
  if (options.simulated && !options.given.empty())
    throw Error("--devices " + std::to_string(*options.simulated) +
                " is for simulated devices alone: leave it out, and write --device once for each device");
  if (options.given.size() > TouchServerSettings::kMaxDevices)
    throw Error("there are " + std::to_string(options.given.size()) + " devices, and a server has at most " +
                std::to_string(TouchServerSettings::kMaxDevices));
  std::vector<NamedDevice> devices(options.simulated.value_or(0), NamedDevice{"", "sim"});
  for (const std::string& text : options.given) devices.push_back(parseNamedDevice(text));
  if (devices.empty()) devices.push_back({"", "sim"});
  return withNames(std::move(devices));
}

std::vector<std::string> replayedFiles(const std::vector<NamedDevice>& devices) {
  std::vector<std::string> files;
  files.reserve(devices.size());
  for (const NamedDevice& device : devices) files.push_back(replayedFile(device.spec));
  return files;
}

}  // namespace hl
