// EnergyBooking: books the energy of one tick in the ledger and limits it, and computes the target from this.
//
//   before   E0 = 1/2 K s- |proxy- - finger|^2         after   E = 1/2 K s+ |proxy+ - finger|^2
//
// each with the energy of the pre-sliding springs (presliding.h). Both use the same finger position, so E - E0 is the
// change by the tick's rules, not by the hand. Without contact, and
// in the tick that makes contact, s- is s+: making contact changes no energy. A tick that ends on its way, between the
// surface that it left and the finger, keeps the stiffness of that surface and adds no energy. If it has met no
// surface, there is no force.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "proxy/mean_stiffness.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"

namespace hl {

/// State of the proxy at the end of a tick.
enum class TickEnd : std::uint8_t {
  kOpen,     ///< at the finger, without active contacts
  kContact,  ///< held by active contacts
  kOnItsWay  ///< without contact: the tick ended before the proxy came to the finger or to a contact
};

class EnergyBooking {
 public:
  EnergyBooking(const ProxyState& state, const ProxySettings& settings, const Vec3& finger);

  /// The part of `step` that the tick's energy budget allows: up to the point nearest the finger, and beyond it as far
  /// as the budget allows. `released_J`: what the step takes out of the pre-sliding springs. RT-safe.
  Vec3 afford(const Vec3& proxy, const Vec3& step, double released_J = 0);
  /// Whether the energy budget is used up: the last step was shortened.
  bool spent() const { return spent_; }

  /// Causes of an energy increase, for booking; `shading` and `bump` as in ShadingNormal.
  struct Causes {
    double shading = 0, bump = 0;
    bool stiffness_textured = false;
  };
  /// Moves the target by the stiffness of the active surfaces, or of those active last, as far as the energy budget
  /// allows. Books the tick and fills the report.
  void close(ProxyState& state, TickEnd end, const MeanStiffness& surfaces, const Causes& causes,
             TickReport& report) const;

 private:
  double affordable(const Vec3& proxy, const Vec3& step, double released_J) const;
  double energy_J(double stiffness, double distance_squared) const;
  double moved_J(const Vec3& proxy, double stiffness) const;
  double wantedStiffness(TickEnd end, const MeanStiffness& surfaces) const;

  const ProxySettings& settings_;
  const Vec3 finger_;
  const bool was_touching_;
  const double stiffness_before_;
  const Vec3 proxy_before_;
  const double presliding_before_J_;
  const double budget_J_;
  bool spent_ = false;
};

}  // namespace hl
