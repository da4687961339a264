// Yielding: surfaces that give way to the force as a spring of compliance C, in series with the servo's spring K.
//
// The proxy stays on the mesh. The mesh was computed for a force F_k; under F the surface is displaced by C (F_k - F).
// With the servo's force F = K s0 (e + C (F_k - F)), e = proxy - finger, s0 the stiffness of the surface:
//
//   F = K s (e + C F_k),   1 / (K s) = 1 / (K s0) + C
//
// So the spring is softened by s, and fixed not at the proxy but at its rest: the proxy displaced by o = C F_k, where
// the surface would be without force. The tick is made with the finger at finger - o: then the planes press with the
// true forces, friction is Coulomb's, and a surface is left where it would not push any more, be that above its mesh.
// 1/2 K s |rest - finger|^2 is the energy of both springs.
//
// An object that is touched in several places yields as a whole: C and s are those of one contact that holds what its
// contacts hold together, along the normal of what they press together. So neither depends on how many faces there are,
// nor on their angles, and F_k counts once. Several objects, or materials, have the mean s by their normal forces
// (mean_stiffness.h). What each pulls adds up, e_i its part of e, as each would settle with its own frames:
//
//   F = K sum s_i (e_i + C_i F_ki),   o = sum s_i (e_i + C_i F_ki) / s - e
//
// Between walls that are not at right angles the sum of s_i e_i has no potential: a finger that goes round there would
// get energy in each round. So the rest goes there only as far as the tank pays for it.
#pragma once

#include "base/fixed_vector.h"
#include "proxy/mean_stiffness.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// Whether a contact yields, by its object or by its material. RT-safe.
bool anyYields(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
               const FixedVector<ProxyContact, kMaxActive>& contacts);

/// Stiffness s of contacts of which one yields, of which the whole pull is along `e`: anchor of the spring - finger.
/// RT-safe.
MeanStiffness yieldingStiffness(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
                                const FixedVector<ProxyContact, kMaxActive>& contacts, const Vec3& e);

/// Before a tick to `finger`, by the contacts of the last one: moves the anchor of the spring to where contacts that
/// yield differently share the pull, as far as the ledger pays for it. Returns the energy change, J, which is booked.
/// RT-safe.
double sharePull(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger);

/// Then: changes stiffness and anchor of the spring by what the frames of clients have changed since. RT-safe.
void yieldToFrames(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

/// After a tick to `finger`, or to where a snap drew it: remembers the contacts, if one of them yields
/// (TickReport::yields). RT-safe.
void rememberYielding(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const TickReport& report,
                      const Vec3& finger);

}  // namespace hl
