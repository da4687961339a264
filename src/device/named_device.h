// Named devices: what a user writes after --device, once for each hand: [NAME=]KIND[:ARGUMENT].
#pragma once

#include <string>
#include <vector>

namespace hl {

struct NamedDevice {
  std::string name;  ///< a letter, then letters, digits, - and _; at most 32; empty: none yet, or there is one device
  std::string spec;  ///< as makeDevice() takes it
};

/// What is before the first '=' is the name, unless a ':' is before it. Throws hl::Error when the name is none.
NamedDevice parseNamedDevice(const std::string& text);

/// Gives a name to those that have none: of two, left and right, in this order; of more, device0, device1, ..., by
/// their number; one alone needs none. Throws hl::Error when two have one name, or one device.
std::vector<NamedDevice> withNames(std::vector<NamedDevice> devices);

}  // namespace hl
