// How far from the origin a finger may be, so that its distance to a scene can be squared and be multiplied by any
// spring, and the result still is a number.
#pragma once

#include "base/vec.h"

namespace hl {

inline constexpr double kFarthestFinger_m = 1e15;  ///< along each axis

/// False also for NaN. RT-safe.
inline bool canBeFinger(const Vec3& p) { return (p.array().abs() <= kFarthestFinger_m).all(); }

}  // namespace hl
