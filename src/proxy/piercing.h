// Piercing: a surface of strength F lets the proxy through when it is pressed harder than F, as skin does a needle.
//
// The surface is pressed by K s |sum of lambda_i n_i|, over the contacts of its object. An object that has been pierced
// is left out of the scene until the proxy no longer overlaps it; then it is as before, also from its other side. So
// the proxy goes on to the finger, or to what else is in its way, and the energy of the spring, 1/2 F^2 / (K s), is
// lost. A pierced object stays where it is and keeps its shape. Bodies that move are never pierced: they give way.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// After a tick: what no longer overlaps the proxy is as before, and what the contacts of the report have pierced is
/// let go. `scene`: with all objects. RT-safe.
void rememberPiercing(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const TickReport& report);

}  // namespace hl
