// BodyHand: a finger's proxy as a hand at the bodies: what they are given of it before a tick, and what they get after
// it.
#pragma once

#include "proxy/field_forces.h"
#include "proxy/proxy.h"
#include "proxy/snapping.h"
#include "touch/body_world.h"

namespace hl {

/// RT-safe.
class BodyHand {
 public:
  /// What the bodies must know of it before they are stepped. `finger`: of now, world frame. `pulls`: whether the
  /// spring makes a force.
  HandAtBodies before(const ProxyState& state, const ProxySettings& settings, const Vec3& finger, bool pulls) const;
  /// After the tick in `scene` that came to `state` and `report`, with the forces of `fields` on the hand, which has
  /// this number at the bodies. Nobody pushes them while the spring makes no force.
  void after(BodyWorld& bodies, std::size_t number, const SceneAt& scene, const ProxyState& state,
             const TickReport& report, const FieldForces& fields, const ProxySettings& settings, const Vec3& finger,
             bool pulls);
  /// What held the proxy at the end of the last tick: for BodiesMemory.
  const FixedVector<HandContact, kContactsOfHand>& heldBy() const { return held_by_; }
  void resume(const FixedVector<HandContact, kContactsOfHand>& held_by) { held_by_ = held_by; }

 private:
  void hold(const SceneAt& scene, const ProxyState& state, const TickReport& report, const Vec3& finger);

  FixedVector<HandContact, kContactsOfHand> held_by_;  // at the end of the last tick
};

}  // namespace hl
