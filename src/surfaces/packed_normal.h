// A direction without a sign or with one, in 32 bits: the place where it meets an octahedron, unfolded to a square.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/vec.h"

namespace hl {

/// What no direction is packed as.
inline constexpr std::uint32_t kNoNormal = 0;
/// Largest angle between a direction and what comes back of it, rad.
inline constexpr double kPackedNormalError_rad = 7e-5;

/// Of a coordinate of the square, -1..1.
inline constexpr double kZeroStep = 32768, kUnitSteps = 32767;

/// `n`: of any length; kNoNormal if that is 0 or no number.
inline std::uint32_t packNormal(const Vec3& n) {
  const double size = n.cwiseAbs().sum();
  if (!(size > 0) || !std::isfinite(size)) return kNoNormal;
  double u = n.x() / size, v = n.y() / size;
  if (n.z() < 0) {
    const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  const auto step = [](double w) { return static_cast<std::uint32_t>(kZeroStep + std::floor(kUnitSteps * w + 0.5)); };
  return step(u) << 16 | step(v);
}

/// Unit; of kNoNormal some direction. RT-safe, the same bits everywhere.
inline Vec3 unpackNormal(std::uint32_t packed) {
  double u = (static_cast<double>(packed >> 16) - kZeroStep) / kUnitSteps;
  double v = (static_cast<double>(packed & 0xffff) - kZeroStep) / kUnitSteps;
  const double w = 1 - std::abs(u) - std::abs(v);
  if (w < 0) {
    const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  return Vec3(u, v, w).normalized();
}

}  // namespace hl
