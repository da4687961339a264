// Small step: how far time may advance while meshes deform, which have no frame in which they are at rest, or while
// several objects close in on the proxy. Nothing takes more than a part of the room that the proxy's centre has; so
// nothing crosses it before the proxy is pushed out again.
#pragma once

#include "proxy/pushed_proxy.h"

namespace hl {

/// Whether a deforming mesh may come near the proxy, or near the way on which the proxy is carried. RT-safe.
bool deformsNear(const PushedProxy& proxy);

/// Until something has taken convergence::kCloseIn of the room, or the tick comes. `left`: steps that are left until
/// then; the last goes all the way. RT-safe.
Advance smallStep(const PushedProxy& proxy, int left);

}  // namespace hl
