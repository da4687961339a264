#include "touch/body_hand.h"

#include <cmath>

namespace hl {

namespace {

using Walls = FixedVector<Vec3, 4>;

// Normals of smooth contacts that together hold the proxy against the snap, and leave it free where the snap does:
// their sum is 0, so that what goes along none of them backwards goes along none of them.
Walls wallsOf(const SnapPoint& snap) {
  Walls walls;
  const Vec3& axis = snap.axis;
  if (snap.free == SnapPoint::Free::kAcrossAxis) {
    walls.push(axis);
    walls.push(-axis);
  } else if (snap.free == SnapPoint::Free::kAlongAxis) {
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    walls.push(u);
    walls.push(-0.5 * u + std::sqrt(0.75) * v);
    walls.push(-0.5 * u - std::sqrt(0.75) * v);
  } else {
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
      walls.push(corner / std::sqrt(3.0));
  }
  return walls;
}

}  // namespace

HandAtBodies BodyHand::before(const ProxyState& state, const ProxySettings& settings, const Vec3& finger,
                              bool pulls) const {
  HandAtBodies hand;
  hand.contacts = held_by_;
  hand.proxy = state.position;
  hand.radius_m = settings.radius;
  hand.stretch = state.anchor() - finger;
  if (pulls && state.free) hand.spring_N_m = settings.spring_N_m * state.stiffness / settings.world_per_device;
  return hand;
}

void BodyHand::hold(const SceneAt& scene, const ProxyState& state, const TickReport& report, const Vec3& finger) {
  for (const ProxyContact& contact : report.contacts) {
    held_by_.push({scene.instance(contact.primitive).key, contact.point, contact.normal, contact.static_friction,
                   contact.static_friction, !state.sticking.isStuck()});
  }
  const std::optional<SnapPoint> snap = heldPoint(state.snap, scene, finger);
  if (!snap) return;
  for (const Vec3& normal : wallsOf(*snap)) held_by_.push({state.snap.key, snap->point, normal, 0, 0, false});
}

void BodyHand::after(BodyWorld& bodies, std::size_t number, const SceneAt& scene, const ProxyState& state,
                     const TickReport& report, const FieldForces& fields, const ProxySettings& settings,
                     const Vec3& finger, bool pulls) {
  const bool touching = pulls && touches(state, report);
  held_by_.clear();
  if (touching) hold(scene, state, report, finger);
  bodies.settle(number, touching ? objectForces(scene, settings, state, report, finger) : ObjectForces{},
                settings.period_s);
  bodies.draw(number, pulls ? fields : FieldForces{}, settings.period_s);
}

}  // namespace hl
