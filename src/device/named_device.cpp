#include "device/named_device.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "device/open_device.h"

namespace hl {

namespace {

// They stand in names of files, in labels of metrics and in addresses.
void requireName(const std::string& name) {
  constexpr std::size_t kLongest = 32;
  const auto fits = [](char c) { return isLetterOrDigit(c) || c == '-' || c == '_'; };
  const bool begins = !name.empty() && isLetter(name.front());
  if (begins && name.size() <= kLongest && std::all_of(name.begin(), name.end(), fits)) return;
  throw Error("'" + name + "' is no name of a device: write a letter, then letters, digits, - or _, at most " +
              std::to_string(kLongest) + " in all");
}

std::string nameOf(std::size_t number, std::size_t devices) {
  if (devices == 1) return "";
  if (devices == 2) return number == 0 ? "left" : "right";
  return "device" + std::to_string(number);
}

void requireApart(const NamedDevice& one, const NamedDevice& other) {
  if (one.name == other.name)
    throw Error("two devices have the name '" + one.name + "': give each its own, as in --device left=" + one.spec +
                " --device right=" + other.spec);
  const std::string key = deviceKey(one.spec);
  if (!key.empty() && key == deviceKey(other.spec))
    throw Error("'" + one.name + "' and '" + other.name + "' are one device: " + one.spec + " and " + other.spec +
                " lead to the same; hl doctor tells which there are");
}

}  // namespace

NamedDevice parseNamedDevice(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || text.find(':') < sign) return {"", text};
  const NamedDevice named{text.substr(0, sign), text.substr(sign + 1)};
  requireName(named.name);
  return named;
}

std::vector<NamedDevice> withNames(std::vector<NamedDevice> devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].name.empty()) devices[i].name = nameOf(i, devices.size());
    for (std::size_t before = 0; before < i; ++before) requireApart(devices[before], devices[i]);
  }
  return devices;
}

}  // namespace hl
