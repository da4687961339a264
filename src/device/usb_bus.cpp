#include "device/usb_bus.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace hl {

namespace {

constexpr unsigned kHubClass = 0x09;

std::string lineOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::optional<unsigned> numberOf(const std::filesystem::path& file, int base) {
  const std::string line = lineOf(file);
  char* end = nullptr;
  const unsigned long number = std::strtoul(line.c_str(), &end, base);
  if (end == line.c_str()) return {};
  return static_cast<unsigned>(number);
}

std::string hexOf(unsigned number) {
  char text[8];
  std::snprintf(text, sizeof text, "%04x", number & 0xFFFFU);
  return text;
}

std::string nodeOf(unsigned bus, unsigned device) {
  char text[32];
  std::snprintf(text, sizeof text, "/%03u/%03u", bus, device);
  return text;
}

std::string nameIn(const std::filesystem::path& folder) {
  const std::string maker = lineOf(folder / "manufacturer"), product = lineOf(folder / "product");
  return maker.empty() || product.empty() ? maker + product : maker + " " + product;
}

}  // namespace

std::string textOf(const UsbId& id) { return hexOf(id.vendor) + ":" + (id.product ? hexOf(*id.product) : "*"); }

bool matches(const UsbId& id, const UsbDevice& device) {
  return device.vendor == id.vendor && (!id.product || device.product == *id.product);
}

std::string udevRuleFor(const UsbId& id) {
  std::string rule = R"(SUBSYSTEM=="usb", ATTR{idVendor}==")" + hexOf(id.vendor) + "\", ";
  if (id.product) rule += R"(ATTR{idProduct}==")" + hexOf(*id.product) + "\", ";
  return rule + R"(MODE="0660", GROUP="plugdev", TAG+="uaccess")";
}

std::vector<UsbDevice> usbDevices(const std::string& described, const std::string& nodes) {
  std::vector<UsbDevice> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(described, none)) {
    const auto vendor = numberOf(entry.path() / "idVendor", 16), product = numberOf(entry.path() / "idProduct", 16);
    if (!vendor || !product || numberOf(entry.path() / "bDeviceClass", 16) == kHubClass) continue;
    const std::string node = nodes + nodeOf(numberOf(entry.path() / "busnum", 10).value_or(0),
                                            numberOf(entry.path() / "devnum", 10).value_or(0));
    found.push_back({static_cast<std::uint16_t>(*vendor), static_cast<std::uint16_t>(*product), nameIn(entry.path()),
                     access(node.c_str(), R_OK | W_OK) == 0});
  }
  std::ranges::sort(found, {}, [](const UsbDevice& one) { return std::pair(one.vendor, one.product); });
  return found;
}

}  // namespace hl
