// Hands step: one tick of several hands at one world of bodies:
//
//   each hand begins -> the bodies step, all hands among them -> each hand ticks, and settles with the bodies
#pragma once

#include <cstdint>
#include <span>

#include "touch/proxy_loop.h"

namespace hl {

struct HandInStep {
  ProxyLoop* loop = nullptr;             ///< null: it is not there
  const TickRequest* request = nullptr;  ///< but for `on_bodies`: what clients do has been given to the loop
  int most_looks = kNoWorkCap;           ///< as in ProxyLoop::step()
  ProxyStep out{};
};

/// All in one scene, at one time. `bodies`: its own; null: it has none. `hands`: kMaxHands at most, each at its
/// number. RT-safe.
void stepHands(const Snapshot& scene, BodyWorld* bodies, BodyLoop& body_loop, std::span<HandInStep> hands);

}  // namespace hl
