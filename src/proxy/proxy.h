// The proxy (the paper's section 3): a sphere that follows the finger by direct linear motion and never enters an
// object. A pure function of (state, snapshot, finger): no threads, devices or clocks.
//
// One tick repeats: gather the primitives in contact; each is convex, so the half-space above its tangent plane in
// configuration space is free of it. Solve for the sub-goal nearest the finger above all of these planes, sweep the
// sphere toward it past all *other* primitives, and stop at the first impact. The split is exact: a primitive is either
// a contact (a plane holds it off) or swept, never both and never neither, by one comparison with one distance.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "scene/snapshot.h"

namespace hl {

struct ProxySettings {
  double radius = 0.001;     ///< m, > 0
  int iteration_cap = 1000;  ///< a tick that needs more stops where it is, at a valid position
};

/// World frame.
struct ProxyState {
  Vec3 position = Vec3::Zero();  ///< centre of the sphere
  bool free = false;             ///< false while no position clear of the scene has been found near the finger
};

/// A plane that holds the proxy at the end of a tick.
struct ProxyContact {
  Vec3 point;           ///< on the surface, nearest the proxy
  Vec3 normal;          ///< unit, from the surface to the proxy
  double multiplier_m;  ///< its share of proxy - finger: sum multiplier_m * normal; times K it is the normal force
  std::uint32_t primitive;
};

struct TickReport {
  FixedVector<ProxyContact, 3> contacts;
  int iterations = 0;
  bool capped = false;  ///< the iteration cap or the room for contacts ended the tick before the local minimum
  bool valid = true;    ///< false when the finger was not finite; then nothing has moved
};

/// A proxy at the finger or, when the finger touches the scene, at a clear place nearby. RT-safe.
ProxyState startProxy(const Snapshot& snapshot, const ProxySettings& settings, const Vec3& finger);

/// Moves the proxy toward the finger, to the local minimum of their distance. RT-safe.
/// Afterwards |proxy - surface| >= radius, and |proxy - finger| is not larger than before.
TickReport tick(ProxyState& state, const Snapshot& snapshot, const ProxySettings& settings, const Vec3& finger);

}  // namespace hl
