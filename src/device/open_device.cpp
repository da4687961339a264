#include "device/open_device.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/printable.h"
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

DevicePointer makeForceDimension(const std::string& choice) {
  return std::make_unique<ForceDimensionDevice>(ForceDimensionChoice::parse(choice));
}

std::string keyOfForceDimension(const std::string& choice) { return ForceDimensionChoice::parse(choice).key(); }

DevicePointer makeFalcon(const std::string& argument) {
  const FalconChoice choice = FalconChoice::parse(argument);
  return std::make_unique<FalconDevice>(makeFalconUsb(choice.index), choice.firmware);
}

std::string keyOfFalcon(const std::string& argument) { return std::to_string(FalconChoice::parse(argument).index); }

DevicePointer makeTouchHd(const std::string& name) {
  checkPrintable(name, "the name of the device");
  return std::make_unique<TouchHdDevice>(name);
}

DevicePointer makeHaply(const std::string& address) { return std::make_unique<HaplyDevice>(address); }

std::string keyOfHaply(const std::string& text) {
  const HaplyAddress address = HaplyAddress::parse(text);
  return address.text() + "/" + address.device_id;
}

std::string keyOfArgument(const std::string& argument) { return argument; }

struct DeviceKind {
  const char* name;
  const char* spec;  ///< how to write it
  DevicePointer (*make)(const std::string& argument);
  std::string (*find)();                            ///< what is there; throws hl::Error with what to install or do
  std::string (*key)(const std::string& argument);  ///< see deviceKey(); null: there are as many as wanted
};

constexpr std::array kKinds{
    DeviceKind{"sim", "sim[:MODEL]", makeSimulated, findSimulated, nullptr},
    DeviceKind{"dhd", "dhd[:INDEX|:serial=NUMBER]", makeForceDimension, ForceDimensionDevice::find,
               keyOfForceDimension},
    DeviceKind{"falcon", "falcon[:INDEX|:FIRMWARE|:INDEX,FIRMWARE]", makeFalcon, FalconDevice::find, keyOfFalcon},
    DeviceKind{"hd", "hd[:NAME]", makeTouchHd, TouchHdDevice::find, keyOfArgument},
    DeviceKind{"haply", "haply[:ID|:URL[/ID]]", makeHaply, HaplyDevice::find, keyOfHaply},
};

const DeviceKind* kindOf(const std::string& spec) {
  const std::string name = spec.substr(0, spec.find(':'));
  const auto* const kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const DeviceKind& k) { return name == k.name; });
  return kind == kKinds.end() ? nullptr : kind;
}

std::string argumentOf(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  return colon == std::string::npos ? "" : spec.substr(colon + 1);
}

}  // namespace

DevicePointer makeDevice(const std::string& spec) {
  const DeviceKind* const kind = kindOf(spec);
  if (kind == nullptr) throw Error("'" + spec + "' is no device: there is " + deviceSpecs());
  return kind->make(argumentOf(spec));
}

std::string deviceKey(const std::string& spec) {
  const DeviceKind* const kind = kindOf(spec);
  if (kind == nullptr || kind->key == nullptr) return "";
  return std::string(kind->name) + ":" + kind->key(argumentOf(spec));
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
