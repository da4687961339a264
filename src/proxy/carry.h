// Carry: what moves does to the proxy between two ticks (the paper's section 9 asks for it). The proxy stands still, or
// goes along with the object whose friction holds it, until an object meets it; that object then pushes it.
//
//   objects that move   are swept in their own frame, so nothing passes through the proxy at any speed
//   meshes that bend    have no such frame: they go a little at a time, never so far that anything of them could cross
//                       the room that the proxy's centre has, and after each step the proxy is pushed out of them
#pragma once

#include "proxy/proxy.h"

namespace hl {

/// Moves the proxy from where it was at state.time_ns to where the objects of the scene leave it at scene.time_ns().
/// Afterwards it is clear of them all, but where several pinch it: then its centre is still outside of each, as long as
/// there is room for a point. RT-safe; at most kMostCarrySteps sweeps or pushes. A mesh that bends by more than
/// kMostBendRadii of the proxy from one tick to the next may pass it.
void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

}  // namespace hl
