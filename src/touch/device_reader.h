// DeviceReader: the device as the servo loop reads it, whatever its driver does.
#pragma once

#include <cstdint>

#include "device/device.h"
#include "device/stylus_reader.h"
#include "touch/loop_exchange.h"

namespace hl {

/// One thread at a time; RT-safe.
class DeviceReader {
 public:
  DeviceReader(Device& device, LoopExchange& exchange) : device_(device), exchange_(exchange) {}

  /// Before the loops run: gives the proxy's loop the place of the finger.
  DeviceSample look(std::int64_t now_ns) noexcept;
  /// The same, and counts arrivals. A driver that throws has lost its device. After a step that threw elsewhere there
  /// is no sample either, so that none is ticked with and the servo goes its way to zero force.
  DeviceSample read(std::int64_t now_ns) noexcept;
  /// The step threw something, in the driver or elsewhere.
  void stepFailed() { step_failed_ = true; }

 private:
  Device& device_;
  LoopExchange& exchange_;
  StylusReader stylus_;
  bool answered_ = false;  // when it was read last
  bool step_failed_ = false;
};

}  // namespace hl
