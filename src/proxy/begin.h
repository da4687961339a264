// Begin: the start position of a proxy, found by the start search over several ticks. startProxy() of proxy.h searches
// all candidates at once.
#pragma once

#include "proxy/proxy_state.h"

namespace hl {

/// Moves a proxy that is not free to a clear start position, if there is one among the finger and the next `places`
/// candidates. Returns whether the proxy is free. The ledger is kept. RT-safe.
bool beginProxy(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger, int places);

}  // namespace hl
