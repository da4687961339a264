// EnergyBooking: one tick's entry in the energy ledger, and the target that comes out of it.
//
//   before   E0 = 1/2 K s- |proxy- - finger|^2         after   E = 1/2 K s+ |proxy+ - finger|^2
// at the same finger position, so E - E0 is the work of the tick's rules, not of the hand. In free space, and in the
// tick of the first contact, s- = s+: making contact books nothing. A tick that ends in free space between a surface
// and the finger has the stiffness of the surface that it left, and adds nothing; if it has met no surface, there is no
// force.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"

namespace hl {

/// How the proxy ended a tick.
enum class TickEnd : std::uint8_t {
  kOpen,     ///< at the finger, with nothing to hold it
  kContact,  ///< held by surfaces
  kOnItsWay  ///< in the air: the tick was ended before the proxy came to the finger or to what holds it
};

/// The stiffness of several surfaces: the mean, weighted by their normal forces. The target stays between finger and
/// proxy, as in the paper's equation (4); a contact fades in with its lambda; s stays within those of the surfaces.
/// Softening each wall's own force, sum s_i lambda_i n_i, would keep none of these: in a narrow groove of one hard and
/// one soft wall it pushes sideways with 1 / (2 sin(opening / 2)) times the force.
class MeanStiffness {
 public:
  void add(double multiplier_m, double stiffness);
  bool empty() const { return most_ < least_; }
  double value() const;

 private:
  double weights_m_ = 0, weighted_m_ = 0;
  double least_ = 1, most_ = 0;
};

class EnergyBooking {
 public:
  EnergyBooking(const ProxyState& state, const ProxySettings& settings, const Vec3& finger);

  /// The part of a step that the tick's energy pays for: to the point nearest the finger, and beyond it as far as the
  /// tank reaches. RT-safe.
  Vec3 afford(const Vec3& proxy, const Vec3& step);
  /// The energy that the tick may add is used up: the last step could not be paid for as a whole.
  bool spent() const { return spent_; }

  /// What turned the proxy's way, for booking by cause; measures as in ShadingNormal.
  struct Causes {
    double shading = 0, bump = 0;
    bool stiffness_textured = false;
  };
  /// Moves the target for the stiffness of the surfaces that hold the proxy, or that did last, as far as the energy
  /// reaches; books the tick, and fills the report.
  void close(ProxyState& state, TickEnd end, const MeanStiffness& surfaces, const Causes& causes,
             TickReport& report) const;

 private:
  double affordable(const Vec3& proxy, const Vec3& step) const;
  double energy_J(double stiffness, double distance_squared) const;
  double moved_J(const Vec3& proxy, double stiffness) const;
  double wantedStiffness(TickEnd end, const MeanStiffness& surfaces) const;

  const ProxySettings& settings_;
  const Vec3 finger_;
  const bool was_touching_;
  const double stiffness_before_;
  const Vec3 proxy_before_;
  const double budget_J_;
  bool spent_ = false;
};

}  // namespace hl
