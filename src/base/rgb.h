// Rgb: a colour as files have it and screens show it (sRGB): red, green and blue, 0..255. It is drawn, and never felt.
#pragma once

#include <array>
#include <cstdint>

namespace hl {

using Rgb = std::array<std::uint8_t, 3>;

/// 0xRRGGBB.
inline std::uint32_t packRgb(const Rgb& colour) {
  return std::uint32_t{colour[0]} << 16U | std::uint32_t{colour[1]} << 8U | std::uint32_t{colour[2]};
}

/// The bits above the lowest 24 do not count.
inline Rgb unpackRgb(std::uint32_t packed) {
  return {static_cast<std::uint8_t>(packed >> 16U), static_cast<std::uint8_t>(packed >> 8U),
          static_cast<std::uint8_t>(packed)};
}

}  // namespace hl
