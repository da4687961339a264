// Yielding: surfaces that give way to the force as a spring of compliance C, in series with the servo's spring K.
//
// The proxy stays on the mesh. The mesh was computed for a force F_k; under F the surface is displaced by C (F_k - F).
// With the servo's force F = K s0 (e + C (F_k - F)), e = proxy - finger, s0 the stiffness of the surface:
//
//   F = K s (e + C F_k),   1 / (K s) = 1 / (K s0) + C
//
// So the target is softened by s, and the spring is fixed not at the proxy but at its rest: the proxy displaced by
// C F_k, where the surface would be without force. The energy 1/2 K s |rest - finger|^2 is that of both springs. Of
// several contacts each softens its own part e_i of e; contacts that do not yield keep theirs.
#pragma once

#include <array>

#include "proxy/energy_booking.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// World frame. `e`: proxy - finger. The parts of it that the contacts hold; their sum is e, unless there is none:
/// along each normal by its multiplier; the rest, which friction holds, in proportion to mu_i lambda_i, or to lambda_i
/// if no contact has friction. RT-safe.
using ContactParts = std::array<Vec3, 3>;
ContactParts partsOf(const FixedVector<ProxyContact, 3>& contacts, const Vec3& e);

/// The pull of a contact, m: its part of target - finger. Times K it is its force on the hand. RT-safe.
inline Vec3 pullOf(const ProxyContact& contact, const Vec3& part, double stiffness) {
  return stiffness * (contact.yields.weight * (part + contact.yields.free_m));
}

/// Finds how the contacts yield, by their parts of `e`, their C and their F_k: fills `yields` of each.
/// `surfaces`: gets the stiffness s of each contact. Returns the rest of the proxy's spring - proxy, m. RT-safe.
Vec3 yieldTo(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate, const Vec3& e,
             FixedVector<ProxyContact, 3>& contacts, MeanStiffness& surfaces);

/// Changes the stiffness and the rest of the spring by what the frames of clients have changed since the last tick.
/// RT-safe.
void followFrames(ProxyState& state, const SceneAt& scene);

/// What the next tick must know of the contacts. RT-safe.
YieldingContacts yieldingOf(const SceneAt& scene, const ComplianceEstimate& estimate, const TickReport& report);

}  // namespace hl
