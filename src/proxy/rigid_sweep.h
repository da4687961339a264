// Rigid sweep: how far time may advance while objects move on screws. In the frame of an object the proxy moves on an
// almost straight line, so a sweep along it finds the time of impact, at any speed.
#pragma once

#include "proxy/pushed_proxy.h"

namespace hl {

/// The advance until an object meets the proxy (`met`); until an object turns too far for a straight sweep or changes
/// its screw; or until the next tick. An object meets the proxy at accuracy::kMetAt of the reach. RT-safe.
Advance rigidSweep(const PushedProxy& proxy);

}  // namespace hl
