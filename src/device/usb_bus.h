// UsbBus: which USB devices the system sees, and whether this process may use them. Read from the kernel's files, so
// that a device is seen that may not be opened.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hl {

struct UsbId {
  std::uint16_t vendor = 0;
  std::optional<std::uint16_t> product;  ///< none: any of the vendor
};

struct UsbDevice {
  std::uint16_t vendor = 0, product = 0;
  std::string name;         ///< as the device says it; may be empty
  bool may_be_used = true;  ///< this process may read and write it
};

/// As lsusb writes it: "0403:cb48"; "1451:*" for any product.
std::string textOf(const UsbId& id);
bool matches(const UsbId& id, const UsbDevice& device);

/// Line for a file in /etc/udev/rules.d that lets whoever sits at this machine, and the group plugdev, use the
/// device.
std::string udevRuleFor(const UsbId& id);

/// All that are plugged in, hubs left out. The folders are the kernel's; tests have their own.
std::vector<UsbDevice> usbDevices(const std::string& described = "/sys/bus/usb/devices",
                                  const std::string& nodes = "/dev/bus/usb");

}  // namespace hl
