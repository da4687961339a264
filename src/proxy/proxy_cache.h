// Proxy cache: primitives that previous ticks have found. It affects only the computing time.
#pragma once

#include "proxy/lookahead_ball.h"
#include "proxy/sweep_cache.h"

namespace hl {

/// Plain values. Owned by the proxy loop, like the state.
struct ProxyCache {
  SweepCache nearby{};
  LookaheadBall ahead{};
};

}  // namespace hl
