// Object forces: the force of each object on the hand in a tick, so that a simulation that moves the objects can apply
// the reaction.
//
// The spring's force K s (proxy - finger) is shared by the active contacts (contact_parts.h). What a snap holds
// (snapping.h) is the force of its object at its point.
#pragma once

#include <cstdint>

#include "base/fixed_vector.h"
#include "proxy/proxy_state.h"
#include "proxy/solver.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// Force of one object on the hand. The hand applies the opposite force to the object.
struct ObjectForce {
  std::uint64_t key = 0;      ///< Instance::key; 0: no object holds the proxy, which is on its way
  Vec3 point = Vec3::Zero();  ///< m, world: point of action on the object; the proxy's position if key is 0
  Vec3 force_N = Vec3::Zero();
};
/// At most one per active contact, and one per object, but for that of a snap.
using ObjectForces = FixedVector<ObjectForce, kMaxActive + 1>;

/// Forces after the tick that returned `state` and `report` for `finger`. Their sum is K (target - finger) /
/// world_per_device, to rounding. RT-safe.
ObjectForces objectForces(const SceneAt& scene, const ProxySettings& settings, const ProxyState& state,
                          const TickReport& report, const Vec3& finger);

}  // namespace hl
