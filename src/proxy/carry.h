// Carry: what moves does to the proxy between two ticks (the paper's section 9 asks for it). The proxy stands still, or
// goes along with the object whose friction holds it, until an object meets it; that object then pushes it (pusher.h).
#pragma once

#include "proxy/proxy_state.h"

namespace hl {

/// Moves the proxy from where it was at state.time_ns to where the objects of the scene leave it at scene.time_ns().
/// Afterwards it is clear of them all, but where several pinch it: then its centre is still outside of each, as long as
/// there is room for a point. Objects that move never pass it, at any speed; a mesh that deforms by more than
/// convergence::kMaxDeformRadii of the proxy from one tick to the next may. RT-safe; at most
/// convergence::kMaxCarrySteps sweeps or small steps.
void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

}  // namespace hl
