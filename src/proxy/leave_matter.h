// Leave matter: when a surface takes the place of another at once (another iso value of a volume, another image of a
// camera), the proxy may find itself in matter. It leaves it on the side of its spring, as if the surface had grown
// there and had pushed it. What the proxy had been within before, through a gap or a pierced surface, it stays within.
#pragma once

#include "proxy/proxy_state.h"
#include "scene/scene_at.h"

namespace hl {

/// In the first tick of a scene with such surfaces: brings a proxy that is in their matter, or too near to them, to a
/// place that is clear of the scene and out of all matter. It is sought along the spring from `finger` to the proxy,
/// and then all around; first among the places within what the proxy was within, then among all. If there is none, the
/// proxy stays. RT-safe; at most convergence::kMaxSites places per way.
void leaveMatter(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger);

/// After a tick: notes the objects in whose matter the proxy is. RT-safe.
void rememberMatter(ProxyState& state, const SceneAt& scene);

}  // namespace hl
