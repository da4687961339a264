// The energy of the servo's spring between finger and target: what the ledger counts.
#pragma once

namespace hl {

/// J, for a spring of K `spring_N_m` at the hand, softened to a part `stiffness` (0..1), whose ends are apart by the
/// root of `distance_squared_D` (m^2 at the hand).
inline double springEnergy_J(double spring_N_m, double stiffness, double distance_squared_D) {
  return 0.5 * spring_N_m * stiffness * distance_squared_D;
}

}  // namespace hl
