// Adhesion: surfaces that hold the proxy until the pull exceeds their adhesion A.
//
// While such a surface holds the proxy, the goal of the tick is not the finger but a point below the surface: the
// finger projected onto the tangent plane, and lowered by what the pull leaves of A, at most by half a radius: an edge
// is a radius below the proxy, and from there all ways over it are equally far. So the proxy follows the surface, and
// friction acts as for a normal force of N + A (Derjaguin, Muller, Toporov 1975: the adhesive force adds to the load);
// it is given what the goal does not press. A tick to this goal counts only if the proxy comes no farther from the
// finger: adhesion never adds energy to the spring. If the tick does not count, a part of the way is tried, which is
// right for an edge; then the proxy stays where it is while the pull is below A, and is released otherwise.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// A tick of a proxy that is held by the contacts `state.adhering`. RT-safe; at most four ticks, which share one work
/// limit.
TickReport tickAdhering(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                        int most_looks);

/// The contacts of the report whose surfaces are adhesive. RT-safe.
AdheringContacts adheringOf(const SceneAt& scene, const ProxySettings& settings, const TickReport& report);

}  // namespace hl
