// Hand-over: how a new proxy becomes what the spring pulls to, without feeding energy.
//
// A proxy that comes late was computed for a finger that has moved on; pulling to it at once may raise the energy of
// the spring, E = 1/2 K s |proxy - finger|^2, and a loop slow enough then shakes the hand (science, fault 4: beyond pi
// sqrt(m / 2K), 14 ms at 75 g and 1.8 kN/m). The monotone hand-over goes toward the new proxy only as far as E stays at
// what it was, plus what the proxy's own ledger has paid for, plus what a tank holds.
#pragma once

#include "base/ledger.h"
#include "base/vec.h"

namespace hl {

/// Where the spring is fixed. Device frame.
struct SpringEnd {
  Vec3 proxy_D = Vec3::Zero();
  double stiffness = 1;  ///< s of the surface, 0..1
};

struct HandOverState {
  SpringEnd end;
  bool pulling = false;  ///< false: in the open, where the end is the finger itself
  Ledger ledger{};       ///< by_cause_J has kLate only
};

/// Moves `state.end` toward `wanted`, seen from the finger where it is now. In the open the end starts at `open_D`:
/// where the finger was two steps ago, the newest that a proxy one step late can have seen.
/// `paid_J`: energy that the proxy's ledger has paid for already. RT-safe.
void handOver(HandOverState& state, LedgerMode mode, double spring_N_m, const SpringEnd& wanted, double paid_J,
              const Vec3& open_D, const Vec3& finger_D);

/// The tank's income from what the device's own friction dissipates while the finger moves: force times way. RT-safe.
void refillFromFriction(HandOverState& state, double friction_N, const Vec3& before_D, const Vec3& finger_D);

}  // namespace hl
