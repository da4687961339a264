// Rigid sweep: how far time may go on while objects move on screws. In the frame of an object the proxy goes past it on
// an all but straight way, so a sweep along that finds when the two meet, at any speed.
#pragma once

#include "proxy/pushed_proxy.h"

namespace hl {

/// Until an object meets the proxy, as told in `met`; or until an object turns too far for a straight sweep, changes
/// its screw, or the tick comes. Objects have met it where they come within accuracy::kMetAt of the reach. RT-safe.
Advance rigidSweep(const PushedProxy& proxy);

}  // namespace hl
