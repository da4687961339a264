// Matter force: what hinders a motion through matter.
#pragma once

namespace hl {

/// A motion at speed v, at the hand, needs the force resistance_N + drag_Ns_m v.
struct MatterForce {
  double resistance_N = 0;  ///< >= 0: below it nothing moves, as while something is cut
  double drag_Ns_m = 0;     ///< >= 0
  bool acts() const { return resistance_N > 0 || drag_Ns_m > 0; }
  bool operator==(const MatterForce&) const = default;
};

}  // namespace hl
