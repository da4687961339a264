// The proxy (the paper's section 3): a sphere that follows the finger by direct linear motion and never enters an
// object. A pure function of (state, snapshot, finger): no threads, devices or clocks.
//
// One tick repeats: gather the primitives in contact. Each is convex, so the half-space above its tangent plane in
// configuration space is free of it. Solve for the sub-goal nearest the finger above all these planes. Sweep the sphere
// toward it past all *other* primitives, and stop at the first impact. One comparison with one distance decides whether
// a primitive is a contact (its plane holds the proxy) or swept, so every primitive is exactly one of the two.
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// A proxy at the finger or, if the finger touches the scene, at a clear position nearby. The whole start search is
/// done at once: thousands of queries if there is no such position. A real-time loop starts with ProxyState{} instead;
/// each tick then tests a few candidates. Does not allocate.
ProxyState startProxy(const SceneAt& scene, const ProxySettings& settings, const Vec3& finger);

/// Moves the proxy toward the finger under the rules of the surfaces in contact, and books the energy. A proxy that is
/// not yet free is first moved to a start position, if one is found. Afterwards |proxy - surface| >= radius, but for
/// objects that the proxy has pierced (piercing.h) and between moving objects that leave it no room. |proxy - finger|
/// does not increase, but for shading and bump maps, pre-sliding springs, snaps and moving objects; what it adds to the
/// spring's energy is booked. `most_looks` (> 0) limits the number of looks (work.h): a recorded tick is replayed with
/// its recorded number. A finger that is not finite or too far changes nothing (Ending::kInvalid). RT-safe.
TickReport tick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                int most_looks = kNoWorkCap);

/// Whether the tick that came to `state` and `report` ended on a surface: then the spring pulls toward it. RT-safe.
inline bool touches(const ProxyState& state, const TickReport& report) {
  return report.valid() && state.free && state.touching;
}

}  // namespace hl
