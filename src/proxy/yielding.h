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
// 1/2 K s |rest - finger|^2 is the energy of both springs. Of several contacts each yields to its own part of the pull.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// Stiffness s of a contact, of which the whole pull is along `e`. RT-safe.
double yieldingStiffness(const SceneAt& scene, const ProxySettings& settings, const ComplianceEstimate& estimate,
                         const ProxyContact& contact, const Vec3& e);

/// Before a tick, by the contacts of the last one: changes stiffness and rest of the spring by what the frames of
/// clients have changed since. RT-safe.
void yieldToFrames(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

/// After a tick to `finger`, or to where a snap drew it: remembers the contacts, if one of them yields. RT-safe.
void rememberYielding(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const TickReport& report,
                      const Vec3& finger);

}  // namespace hl
