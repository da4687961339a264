// The proxy (the paper's section 3): a sphere that follows the finger by direct linear motion and never enters an
// object. A pure function of (state, snapshot, finger): no threads, devices or clocks.
//
// One tick repeats: gather the primitives in contact; each is convex, so the half-space above its tangent plane in
// configuration space is free of it. Solve for the sub-goal nearest the finger above all of these planes, sweep the
// sphere toward it past all *other* primitives, and stop at the first impact. The split is exact: a primitive is either
// a contact (a plane holds it off) or swept, never both and never neither, by one comparison with one distance.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// A proxy at the finger or, when the finger touches the scene, at a clear place nearby, looked for at once wherever
/// there may be one: thousands of searches where there is none. A loop starts with ProxyState{} instead: each tick then
/// looks at a few places, until one is clear. Does not allocate.
ProxyState startProxy(const SceneAt& scene, const ProxySettings& settings, const Vec3& finger);

/// Moves the proxy, or one that is not free to a place where it can begin, toward the finger under the rules of the
/// surfaces it touches, and accounts for the energy. RT-safe. Afterwards |proxy - surface| >= radius. Without shading
/// and bump maps |proxy - finger| is not larger than before. `most_looks`, > 0: its work is used up after so many,
/// as that of the tick was which is made again.
TickReport tick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                int most_looks = kNoWorkCap);

}  // namespace hl
