// Rgb: a colour as files have it and screens show it (sRGB): red, green and blue, 0..255. It is drawn, and never felt.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace hl {

using Rgb = std::array<std::uint8_t, 3>;
inline constexpr Rgb kWhite{255, 255, 255};

/// A part of a colour of 0..1 as a byte; beyond these it is the nearer one, and what is no number is 0.
inline std::uint8_t colourByte(double part) {
  return part > 0 ? static_cast<std::uint8_t>(std::lround(255 * std::min(part, 1.0))) : std::uint8_t{0};
}

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
