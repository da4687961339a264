// The bytes that HL and a Falcon exchange (libnifalcon/libnifalcon, src/firmware/FalconFirmwareNovintSDK.cpp): frames
// of 16 bytes, three 16-bit numbers in nibbles, and how the firmware gets in. No USB here: the line is FalconTransport.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace hl {

using FalconFrame = std::array<std::uint8_t, 16>;

struct FalconCommand {
  std::array<std::int16_t, 3> motors{};
  bool home = false;  ///< ask for homing: the person moves the tip out and in until each encoder has met its mark
};

struct FalconReply {
  std::array<std::int16_t, 3> encoders{};
  std::uint8_t buttons = 0;  ///< 4 bits
  std::uint8_t homed = 0;    ///< a bit for each leg
};

inline constexpr std::uint8_t kFalconAllHomed = 7;

FalconFrame encode(const FalconCommand& command);
/// The last whole frame in `bytes`; false when there is none.
bool decode(std::span<const std::uint8_t> bytes, FalconReply& reply);

}  // namespace hl
