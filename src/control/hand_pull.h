// HandPull: what another program, such as a robot's, wants the hand to feel besides the scene: a force, and a spring to
// a place. Each counts until its time is over, so that a program that hangs or dies lets go of the hand. RT-safe.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "control/effects.h"

namespace hl {

/// Frame D. All zero: none.
struct HandPull {
  std::int64_t force_until_ns = 0;  ///< on the clock of the servo; it counts before this time, not at it
  Vec3 force_N = Vec3::Zero();
  std::int64_t spring_until_ns = 0;  ///< the same
  double spring_N_m = 0;
  double damping_Ns_m = 0;  ///< of the spring where nothing is touched: the more of it and the effects' own counts
  Vec3 place_D = Vec3::Zero();
};

/// The effects of a servo step at `now_ns`: `own`, and what counts of `pull`. Two springs are one of their stiffness
/// together, at the place where they balance: k1 (p1 - x) + k2 (p2 - x) = (k1 + k2) ((k1 p1 + k2 p2) / (k1 + k2) - x).
Effects withPull(const Effects& own, const HandPull& pull, std::int64_t now_ns);

}  // namespace hl
