#include "control/passivity_guard.h"

#include <algorithm>

namespace hl {

Vec3 dampedToPassive(PassivityGuard& guard, const PassivitySettings& settings, const Vec3& spring_N, const Vec3& way,
                     bool touching, double period_s) {
  guard.energy_J -= guard.held_N.dot(way);
  if (!touching) guard.energy_J = std::min(guard.energy_J, 0.0);
  const double square_m2 = way.squaredNorm();
  if (!touching || !(guard.energy_J < 0) || !(square_m2 > 0)) return spring_N;
  const double damping_Ns_m = std::min(-guard.energy_J * period_s / square_m2, settings.damping_limit_Ns_m);
  guard.dissipated_J += damping_Ns_m * square_m2 / period_s;
  return spring_N - damping_Ns_m / period_s * way;
}

}  // namespace hl
