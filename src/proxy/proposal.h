// Proposal: the next step of a tick, its active contacts, and the rule by which it was found.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "proxy/contacts.h"
#include "proxy/presliding.h"
#include "proxy/solver.h"
#include "proxy/surface.h"

namespace hl {

/// An active contact of a proposal.
struct ActiveContact {
  std::size_t contact = 0;     ///< number in the contact set
  SurfacePoint place;          ///< the contact point, with the true normal
  Vec3 normal = Vec3::Zero();  ///< the shading normal
  double multiplier_m = 0;
};

/// The contact point of a contact. RT-safe.
inline SurfacePoint placeOf(const Contact& contact) {
  return {contact.primitive, contact.plane.normal, contact.weights};
}

/// World frame, relative to the proxy.
struct Proposal {
  enum class Rule : std::uint8_t {
    kPlain,  ///< the point nearest the goal above the planes of the contacts
    kCuts,   ///< also above the planes of the recent cuts (recent_cuts.h)
    kFelt,   ///< under the rules of the surfaces (surface_rules.h)
  };
  /// Whether the passes over the rules of the surfaces have converged.
  enum class Rest : std::uint8_t {
    kGoesOn,
    kSettles,  ///< the proxy rests on these planes at the step's end
    kStays,    ///< the same, and there every contact is on the same face as now
  };

  /// What friction and viscosity do to the step.
  enum class Resistance : std::uint8_t {
    kNone,
    kActs,       ///< the proxy slips less than it is pulled, or sticks
    kPreslides,  ///< friction holds it, on its pre-sliding springs
  };

  Rule rule = Rule::kPlain;
  Rest rest = Rest::kGoesOn;
  Resistance resistance = Resistance::kNone;
  bool may_raise_energy = false;  ///< shading turns the planes: the step may raise the spring's energy
  Vec3 step = Vec3::Zero();
  FixedVector<ActiveContact, kMaxActive> active;
  double shading = 0, bump = 0;  ///< the largest turns of the active shading normals, as in ShadingNormal
  double viscous = 0;            ///< pull used up by viscosity per metre of the step
  PreslidingSprings springs;     ///< before the step, on the contacts of now
  Vec3 held = Vec3::Zero();      ///< m, the pull that friction and viscosity hold after the step

  bool preslides() const { return resistance == Resistance::kPreslides; }
  /// Whether the step never raises the energy of the spring and of the pre-sliding springs together, if the goal is the
  /// finger. Other steps are paid for (energy_booking.h).
  bool descends() const { return !may_raise_energy; }
};

}  // namespace hl
