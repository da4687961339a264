// Body suite: every engine on every scene of cubes: how long a step takes, what energy comes from nowhere, how far the
// cubes are one in the other at the end, and what a finger feels that pushes one.
#pragma once

#include <functional>
#include <string>

#include "tick/timing.h"

namespace hl::bench {

struct BodyRow {
  std::string scene, engine;
  Timing times;          ///< of the thread's processor time: what else the machine does is not counted
  double gained_J = 0;   ///< sum of what the energy of the cubes rises by; not where a finger pushes
  double overlap_m = 0;  ///< at the end
  double speed_m_s = 0;  ///< of the fastest, at the end
  double force_N = 0;    ///< on the cube that is pushed, mean of the last half second
  double ripple_N = 0;   ///< peak to peak, then
};

/// HL, and with `peers` the others that were built in.
void runBodySuite(bool peers, const std::function<void(const BodyRow&)>& output);

}  // namespace hl::bench
