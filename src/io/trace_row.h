// TraceRow: what one tick of a trace came to.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace hl {

/// World frame; seconds, metres, newtons, joules.
struct TraceRow {
  double t = 0;
  Vec3 finger = Vec3::Zero(), proxy = Vec3::Zero(), target = Vec3::Zero(), force = Vec3::Zero();
  int contacts = 0;  ///< active planes at the end of the tick
  int iterations = 0;
  double injected_J = 0;     ///< energy that the tick added to the spring (positive) or took (negative)
  std::int64_t tick_ns = 0;  ///< the one column that differs from run to run
};

}  // namespace hl
