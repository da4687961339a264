// The passivity guard: an observer of the energy that the spring to the proxy gives and takes, and a damper that takes
// back what it has given too much (Hannaford and Ryu, "Time-domain passivity control of haptic interfaces", IEEE
// Trans. Robotics and Automation 18(1), 2002). It knows nothing of why a loop feeds energy: too stiff, too late, a
// broken scene. Optional: at slow speeds its damper feels rough, as a speed from encoder counts is.
//
//   E[n] = E[n-1] - F[n-1] . (x[n] - x[n-1])           exact, as the device holds F between two steps
//   E < 0:  F[n] -= a v,   a = min(-E / (T |v|^2), limit)
#pragma once

#include "base/vec.h"

namespace hl {

struct PassivitySettings {
  bool on = false;
  /// Of the damper, N s/m: a sampled damper is stable below 2 m / T; 20 with the 75 g of a PHANToM at 1 kHz is far
  /// below.
  double damping_limit_Ns_m = 20;
};

/// Between steps. Owned by the servo.
struct PassivityGuard {
  double energy_J = 0;         ///< taken from the hand less given to it; below zero it is a debt
  Vec3 held_N = Vec3::Zero();  ///< what the last step made but for the effects
  double dissipated_J = 0;     ///< what the damper was made for, since the start
};

/// Watches the last step, in which the finger went `way`, and adds the damper to `spring_N`. `touching` false: the
/// finger is free, and what it did not take back of the surface is forgotten; a debt is not. RT-safe.
Vec3 dampedToPassive(PassivityGuard& guard, const PassivitySettings& settings, const Vec3& spring_N, const Vec3& way,
                     bool touching, double period_s);

}  // namespace hl
