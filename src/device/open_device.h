// Devices by name: what a user writes after --device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/device.h"

namespace hl {

/// The device that `spec`, KIND or KIND:ARGUMENT, names. Not open. Throws hl::Error with the kinds there are.
std::unique_ptr<Device> makeDevice(const std::string& spec);
/// The same, open. Throws hl::Error with what to do when it cannot be had.
std::unique_ptr<Device> openDevice(const std::string& spec);

/// The same for two specs that are known to lead to one device; empty: there are as many as wanted. Two specs with
/// different keys may still lead to one (an index and a serial number): then the second does not open.
std::string deviceKey(const std::string& spec);

/// How to write every spec, with | between them.
std::string deviceSpecs();

/// What is known of one kind of device on this machine.
struct DevicePresence {
  std::string kind;
  std::string text;  ///< what is there, or what to install
};
std::vector<DevicePresence> findDevices();

}  // namespace hl
