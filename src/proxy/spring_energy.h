// The servo's spring between finger and target: its stiffness as it is felt, and its energy as counted in the ledger.
#pragma once

#include <algorithm>

#include "base/ledger.h"
#include "proxy/proxy_state.h"
#include "proxy/tolerances.h"

namespace hl {

/// N/m, above 0: what forces in N, N s/m and N/m at the hand are divided by to get lengths. K s of the last tick; of a
/// spring or a surface without stiffness the least.
inline double feltSpring_N_m(const ProxySettings& settings, const ProxyState& state) {
  return std::max(settings.spring_N_m, accuracy::kMinSpring_N_m) * std::max(state.stiffness, accuracy::kMinStiffness);
}

/// J, of the proxy's spring, for a finger at this place.
inline double springEnergy_J(const ProxySettings& settings, const ProxyState& state, const Vec3& finger) {
  const Vec3 gap_D = (state.anchor() - finger) / settings.world_per_device;
  return springEnergy_J(settings.spring_N_m, state.stiffness, gap_D.squaredNorm());
}

}  // namespace hl
