// The energy of the servo's spring between finger and target, as counted in the ledger.
#pragma once

#include "proxy/proxy_state.h"

namespace hl {

/// J, for a spring of stiffness K `spring_N_m` at the hand, reduced by the factor `stiffness` (0..1).
/// `distance_squared_D`: squared length of the spring, m^2 at the hand.
inline double springEnergy_J(double spring_N_m, double stiffness, double distance_squared_D) {
  return 0.5 * spring_N_m * stiffness * distance_squared_D;
}

/// The same of the proxy's spring, for a finger at this place.
inline double springEnergy_J(const ProxySettings& settings, const ProxyState& state, const Vec3& finger) {
  const Vec3 gap_D = (state.position + state.rest_offset_m - finger) / settings.world_per_device;
  return springEnergy_J(settings.spring_N_m, state.stiffness, gap_D.squaredNorm());
}

}  // namespace hl
