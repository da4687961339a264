// Rare values: what few devices and scenes have is written for all steps of a block or for none. None comes back as
// zero, so only what is zero to the bit may be left out: -0 is another number.
#pragma once

#include <bit>
#include <cstdint>

#include "base/vec.h"

namespace hl {

inline bool isZeroToTheBit(double value) { return std::bit_cast<std::uint64_t>(value) == 0; }
inline bool isZeroToTheBit(const Vec3& v) {
  return isZeroToTheBit(v.x()) && isZeroToTheBit(v.y()) && isZeroToTheBit(v.z());
}

}  // namespace hl
