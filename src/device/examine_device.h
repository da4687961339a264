// What stands between a user and a device, looked at step by step: USB, the rights to it, the vendor's library, the
// locale, whether it opens, whether it is calibrated. Each failure says what to do.
#pragma once

#include <string>
#include <vector>

#include "device/device.h"
#include "device/usb_bus.h"

namespace hl {

struct Finding {
  std::string what;  ///< "usb", "library", ...
  bool good = true;
  std::string text;    ///< what was found
  std::string advice;  ///< what to do, lines; empty where nothing has to be done
};

/// Of the device that `spec` names, without opening it: USB, library, locale. Throws hl::Error when `spec` is no
/// device.
std::vector<Finding> examineSurroundings(const std::string& spec, const std::vector<UsbDevice>& usb);

/// Opens `device` and waits up to `patience_s` until it is ready: what became of that, and whether it is ready.
std::vector<Finding> examineOpening(const std::string& spec, Device& device, double patience_s);

bool allGood(const std::vector<Finding>& findings);

}  // namespace hl
