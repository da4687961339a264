// The energy ledger: what the rules of a tick did to the energy of the spring, by cause, and a tank that pays for it.
//
// The spring between device and target stores E = 1/2 K s |proxy - finger|^2. A tick that leaves E no larger than it
// was at the same finger position is passive whatever the geometry (science, fault 3); shading, bump maps and stiffness
// maps may raise it. What they add is taken from the tank; what the tank cannot pay is not done.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

namespace hl {

enum class LedgerMode : std::uint8_t {
  kTank,    ///< rules may add what the tank holds; dissipation refills it
  kStrict,  ///< a tank that is always empty: no tick adds energy
  kReport,  ///< nothing is refused, only counted
};

enum class EnergyCause : std::uint8_t { kShading, kStiffness, kTexture, kMoving, kLate };
inline constexpr std::size_t kEnergyCauses = 5;
inline constexpr std::array<const char*, kEnergyCauses> kEnergyCauseNames{"shading", "stiffness", "texture", "moving",
                                                                          "late hand-over"};

/// J, of a spring of stiffness K `spring_N_m` at the hand, reduced by the factor `stiffness` (0..1).
/// `distance_squared_D`: squared length of the spring, m^2 at the hand. RT-safe.
inline double springEnergy_J(double spring_N_m, double stiffness, double distance_squared_D) {
  return 0.5 * spring_N_m * stiffness * distance_squared_D;
}

inline constexpr double kTankStart_J = 0.010;
inline constexpr double kTankFull_J = 0.050;

/// Of one session. Joules, at the hand.
struct Ledger {
  double tank_J = kTankStart_J;
  double injected_J = 0;    ///< sum over ticks of what each added, all causes together
  double dissipated_J = 0;  ///< sum of what each took away, a positive number
  std::array<double, kEnergyCauses> by_cause_J{};

  /// What one tick may add. RT-safe.
  double budget_J(LedgerMode mode) const;
  /// Books one tick: `net_J` > 0 is paid by the tank, < 0 refills it when `refill`. RT-safe.
  void book(double net_J, bool refill);
  /// Puts energy >= 0, that something else has taken out, into the tank. RT-safe.
  void refill(double joules);
  void add(EnergyCause cause, double joules) { by_cause_J[static_cast<std::size_t>(cause)] += joules; }
};

/// The largest part 0..1 of `way` that raises |e|^2 by no more than `allowance` >= 0 (m^2), e the vector from the
/// finger: A a^2 + 2 B a <= allowance with A = |way|^2, B = way . e. RT-safe.
double partWithin(const Vec3& e, const Vec3& way, double allowance);

}  // namespace hl
