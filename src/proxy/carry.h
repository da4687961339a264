// Carry: the effect of moving objects on the proxy between two ticks (the paper's section 9 asks for it). The proxy
// stands still, or moves with the object whose friction holds it, until an object meets it. That object then pushes it
// (pusher.h).
#pragma once

#include "proxy/proxy_state.h"

namespace hl {

/// Moves the proxy from its position at state.time_ns to its position at scene.time_ns(), pushed by the moving objects.
/// Afterwards it is clear of all objects, unless several pinch it: then its centre is still outside each of them, as
/// long as there is room for a point. Moving objects never pass the proxy, at any speed. A mesh that deforms by more
/// than convergence::kMaxDeformRadii proxy radii between two ticks may pass it. RT-safe; at most
/// convergence::kMaxCarrySteps sweeps or small steps, whose cost the tick's limit of work counts too: after a costly
/// carry the tick makes one step.
void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

}  // namespace hl
