// Object forces: what each object does to the hand in a tick, so that whatever moves the objects can push back.
//
// The spring's force K s (proxy - finger) is that of the active contacts: contact i presses with K s lambda_i along its
// normal; what is left is friction, shared out by how much friction each contact may give, mu_i lambda_i, and where
// none has any, by lambda_i.
#pragma once

#include <cstdint>

#include "base/fixed_vector.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// On the hand, by one object; the hand does the opposite to the object.
struct ObjectForce {
  std::uint64_t key = 0;      ///< Instance::key; 0: the proxy was on its way, and no object holds it
  Vec3 point = Vec3::Zero();  ///< m, world: where it acts on the object; the proxy, for no object
  Vec3 force_N = Vec3::Zero();
};
/// One for each active contact at most; no two of one object.
using ObjectForces = FixedVector<ObjectForce, 3>;

/// Of the tick that left `state` and `report` with the finger there. The sum is K (target - finger) / world_per_device,
/// to rounding. RT-safe.
ObjectForces objectForces(const SceneAt& scene, const ProxySettings& settings, const ProxyState& state,
                          const TickReport& report, const Vec3& finger);

}  // namespace hl
