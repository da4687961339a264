// The direction of a vector of any length.
#pragma once

#include <cmath>
#include <optional>

#include "base/vec.h"

namespace hl {

/// The direction of v, of any finite length but 0; nothing for 0 and for what is not finite. The squares of v itself
/// may leave the range of doubles, so it is brought near 1 first, by a power of two, which rounds nothing. RT-safe.
inline std::optional<Vec3> unitOf(const Vec3& v) {
  if (!v.allFinite() || v.isZero(0)) return {};
  const int exponent = std::ilogb(v.cwiseAbs().maxCoeff());
  return Vec3(std::scalbn(v.x(), -exponent), std::scalbn(v.y(), -exponent), std::scalbn(v.z(), -exponent)).normalized();
}

}  // namespace hl
