// Changed stiffness: what a client or a user makes of the surfaces that hold the proxy, while they hold it. A stiffness
// that rises adds energy to the spring. Where the proxy slides to a stiffer place that is the rules' doing, and the
// tank pays for it; here it is the client's, as motion of an object is, and nobody pays.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// Before a tick: where the surfaces of the last contacts have another stiffness now, the spring has so many times its
/// stiffness. RT-safe.
void followStiffness(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

/// After a tick: remembers the surfaces of its contacts. RT-safe.
void rememberStiffness(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                       const TickReport& report);

}  // namespace hl
