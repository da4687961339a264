#include "device/open_device.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "device/falcon/falcon_device.h"
#include "device/force_dimension/force_dimension_device.h"
#include "device/haply/haply_device.h"
#include "device/simulated_device.h"
#include "device/touch_hd/touch_hd_device.h"

namespace hl {

namespace {

using DevicePointer = std::unique_ptr<Device>;

DevicePointer makeSimulated(const std::string& model) {
  SimulatedDeviceSettings settings;
  if (!model.empty()) settings.model = deviceModel(model);
  return std::make_unique<SimulatedDevice>(settings);
}

std::string findSimulated() { return simulatedModelNames() + " (always there)"; }

template <typename Driver>
DevicePointer makeDriver(const std::string& argument) {
  if (!argument.empty()) throw Error("'" + argument + "' is too much: this device takes no argument");
  return std::make_unique<Driver>();
}

DevicePointer makeFalcon(const std::string& firmware) {
  return std::make_unique<FalconDevice>(makeFalconUsb(), firmware);
}

DevicePointer makeHaply(const std::string& url) { return std::make_unique<HaplyDevice>(url); }

struct DeviceKind {
  const char* name;
  const char* spec;  ///< how to write it
  DevicePointer (*make)(const std::string& argument);
  std::string (*find)();  ///< what is there; throws hl::Error with what to install or do
};

constexpr std::array kKinds{
    DeviceKind{"sim", "sim[:MODEL]", makeSimulated, findSimulated},
    DeviceKind{"dhd", "dhd", makeDriver<ForceDimensionDevice>, ForceDimensionDevice::find},
    DeviceKind{"falcon", "falcon[:FIRMWARE]", makeFalcon, FalconDevice::find},
    DeviceKind{"hd", "hd", makeDriver<TouchHdDevice>, TouchHdDevice::find},
    DeviceKind{"haply", "haply[:URL]", makeHaply, HaplyDevice::find},
};

}  // namespace

DevicePointer makeDevice(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  const std::string name = spec.substr(0, colon);
  const auto* const kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const DeviceKind& k) { return name == k.name; });
  if (kind == kKinds.end()) throw Error("'" + spec + "' is no device: there is " + deviceSpecs());
  return kind->make(colon == std::string::npos ? "" : spec.substr(colon + 1));
}

DevicePointer openDevice(const std::string& spec) {
  DevicePointer device = makeDevice(spec);
  device->open();
  return device;
}

std::string deviceSpecs() {
  std::string specs;
  for (const DeviceKind& kind : kKinds) specs += (specs.empty() ? "" : "|") + std::string(kind.spec);
  return specs;
}

std::vector<DevicePresence> findDevices() {
  const auto text_of = [](const DeviceKind& kind) -> std::string {
    try {
      return kind.find();
    } catch (const Error& error) {
      return error.what();
    }
  };
  std::vector<DevicePresence> found;
  found.reserve(std::size(kKinds));
  for (const DeviceKind& kind : kKinds) found.push_back({kind.name, text_of(kind)});
  return found;
}

}  // namespace hl
