// Follow deformation: what the estimate of the compliance (compliance_estimate.h) sees of the ticks.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// Before a tick, after the proxy was carried: follows what the mesh has moved since the last tick. RT-safe.
void followDeformation(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);
/// After a tick to `finger`, or to where a snap drew it: remembers the contact and its force. RT-safe.
void rememberDeformation(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                         const TickReport& report, const Vec3& finger);

}  // namespace hl
