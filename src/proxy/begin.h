// Begin: the first place of a proxy, found by its start search. startProxy() of proxy.h looks everywhere at once.
#pragma once

#include "proxy/proxy_state.h"

namespace hl {

/// Moves a proxy that is not free to a place where it can begin, if there is one among the next `places`. What the
/// session has booked stays. RT-safe.
bool beginProxy(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger, int places);

}  // namespace hl
