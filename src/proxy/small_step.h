// Small step: how far time may advance while meshes deform (they have no frame in which they stand still), or while
// several objects close in on the proxy. In one step nothing uses up more than a fraction of the clearance of the
// proxy's centre, so nothing crosses the centre before the proxy is pushed out again.
#pragma once

#include "proxy/pushed_proxy.h"

namespace hl {

/// Whether a deforming mesh may come near the proxy or near its path with the carrier. RT-safe.
bool deformsNear(const PushedProxy& proxy);

/// The advance until something has used up convergence::kCloseIn of the clearance, or until the next tick. `left`:
/// number of steps left; the last one goes to the end. RT-safe.
Advance smallStep(const PushedProxy& proxy, int left);

}  // namespace hl
