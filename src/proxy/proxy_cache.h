// Proxy cache: what ticks have met of the scene. It decides nothing but how long the next tick takes.
#pragma once

#include "proxy/lookahead_ball.h"
#include "proxy/sweep_cache.h"

namespace hl {

/// Plain values. Owned by the proxy loop, as the state.
struct ProxyCache {
  SweepCache nearby{};
  LookaheadBall ahead{};
};

}  // namespace hl
