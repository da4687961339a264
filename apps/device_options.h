// Options of the haptic devices: which there are, what each is called, and whether they stop together. The same for hl
// touch, hl record and hld.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "device/named_device.h"

namespace hl {

struct DeviceOptions {
  std::vector<std::string> given;          ///< as written after --device; none: one that is simulated
  std::optional<std::uint32_t> simulated;  ///< how many simulated ones; absent: those that are given
  bool faults_joined = false;              ///< a fault of one device stops all
};

/// --device and --faults. `options` must outlive `command`.
void addDeviceOptions(CLI::App& command, DeviceOptions& options);
/// --devices, the short form for simulated ones.
void addSimulatedDevicesOption(CLI::App& command, DeviceOptions& options);

/// All that are wanted, each with its name. Throws hl::Error when they cannot be had together.
std::vector<NamedDevice> devicesOf(const DeviceOptions& options);

/// What recordings the devices replay.
std::vector<std::string> replayedFiles(const std::vector<NamedDevice>& devices);

}  // namespace hl
