// Account: one tick's entry in the energy ledger, and the target that comes out of it.
//
//   before   E0 = 1/2 K s- |proxy- - finger|^2         after   E = 1/2 K s+ |proxy+ - finger|^2
// at the same finger position, so that E - E0 is what the tick's rules did, not what the hand did. In the open, and on
// the tick that lands, s- is s+: coming into contact charges nothing.
#pragma once

#include "base/vec.h"
#include "proxy/proxy.h"

namespace hl {

class Account {
 public:
  Account(const ProxyState& state, const ProxySettings& settings, const Vec3& finger);

  /// The part 0..1 of a step that the tick's energy pays for: to the point nearest the finger, and beyond it as far as
  /// the tank reaches. RT-safe.
  double affordable(const Vec3& proxy, const Vec3& step) const;

  /// What bent the proxy's way, for booking by cause; the bends as BentNormal has them.
  struct Causes {
    double shading = 0, bump = 0;
    bool stiffness_textured = false;
  };
  /// Moves the target for the surfaces' stiffness as far as the energy reaches, books the tick, and fills the report.
  void close(ProxyState& state, const Causes& causes, TickReport& report) const;

 private:
  double energy_J(double stiffness, double distance_squared) const;

  const ProxySettings& settings_;
  const Vec3 finger_;
  const bool was_touching_;
  const double stiffness_before_;
  const double distance_before_squared_;
  const double budget_J_;
};

}  // namespace hl
