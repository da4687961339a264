// The energy of the servo's spring between finger and target, as counted in the ledger.
#pragma once

namespace hl {

/// J, for a spring of stiffness K `spring_N_m` at the hand, reduced by the factor `stiffness` (0..1).
/// `distance_squared_D`: squared length of the spring, m^2 at the hand.
inline double springEnergy_J(double spring_N_m, double stiffness, double distance_squared_D) {
  return 0.5 * spring_N_m * stiffness * distance_squared_D;
}

}  // namespace hl
