// Proposal: the step that a tick wants to make next, what holds it, and by which rule it was found.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "proxy/contacts.h"
#include "proxy/surface.h"

namespace hl {

/// A contact that holds the proxy in a proposal.
struct ActiveContact {
  std::size_t contact = 0;     ///< number in the contact set
  SurfacePoint place;          ///< where it is touched; its normal is the true one
  Vec3 normal = Vec3::Zero();  ///< as it feels
  double multiplier_m = 0;
};

/// Where a contact is touched. RT-safe.
inline SurfacePoint placeOf(const Contact& contact) {
  return {contact.primitive, contact.plane.normal, contact.weights};
}

/// World frame, relative to the proxy.
struct Proposal {
  enum class Rule : std::uint8_t {
    kPlain,  ///< the point nearest the goal above the planes of the contacts
    kCuts,   ///< above those of what held the last step too (recent_cuts.h)
    kFelt,   ///< under the rules of the surfaces (surface_rules.h)
  };
  /// Whether the passes over the surfaces' rules have come to an end.
  enum class Rest : std::uint8_t {
    kGoesOn,
    kSettles,  ///< the proxy rests on these planes at the step's end
    kStays,    ///< and there every contact is on the same face as now
  };

  Rule rule = Rule::kPlain;
  Rest rest = Rest::kGoesOn;
  bool may_raise_energy = false;  ///< the step is not plain descent: it may raise the spring's energy
  bool resisted = false;          ///< friction or viscosity act on it
  bool preslides = false;         ///< static friction holds the proxy, on its pre-sliding springs
  Vec3 step = Vec3::Zero();
  FixedVector<ActiveContact, 3> active;
  double shading = 0, bump = 0;  ///< the largest of the active contacts, as in ShadingNormal
  double viscous = 0;            ///< pull that viscosity uses for each metre of the step
  double presliding_ratio = 0;   ///< SlipResistance::presliding_ratio
  Vec3 held = Vec3::Zero();      ///< m, the pull that friction holds after the step
};

}  // namespace hl
