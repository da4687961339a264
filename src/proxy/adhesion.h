// Adhesion: surfaces that keep the proxy until it is pulled off by more than their adhesion A.
//
// While such a surface holds the proxy, the tick's goal is not the finger but a place beneath the surface: the finger
// on the tangent plane, pressed by what of A the pull leaves, by a radius at most. So the proxy follows the surface,
// and friction acts as if it were pressed by N + A (Derjaguin, Muller, Toporov 1975: the adhesive force adds to the
// load). A tick to this goal counts only if the proxy comes no farther from the finger by it: adhesion never adds to
// the energy of the spring. Where it does not count the proxy stays where it is, as long as the pull is below A, or
// lets go.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// A tick of a proxy that `state.adhering` holds. RT-safe; at most three ticks that share one budget of work.
TickReport tickHeld(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                    int most_looks);

/// Those of the contacts whose surfaces are adhesive. RT-safe.
AdheringContacts adheringOf(const SceneAt& scene, const ProxySettings& settings, const TickReport& report);

}  // namespace hl
