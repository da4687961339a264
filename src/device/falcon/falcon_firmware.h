// The firmware of a Falcon: it has none of its own after power-on; the host sends it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/falcon/falcon_transport.h"

namespace hl {

/// The user's file; Novint's firmware is not HL's to give. Throws hl::Error with where it is to be had.
std::vector<std::uint8_t> readFalconFirmware(const std::string& file);
/// Sends it and sets the line for frames. False when the device does not answer as it should.
bool loadFalconFirmware(FalconTransport& transport, const std::vector<std::uint8_t>& firmware);

}  // namespace hl
