#include "touch/body_hand.h"

namespace hl {

void BodyHand::before(BodyWorld& bodies, std::int64_t now_ns, const ProxyState& state, const ProxySettings& settings,
                      const Vec3& finger, bool pulls) {
  HandAtBodies hand;
  hand.contacts = held_by_;
  hand.proxy = state.position;
  hand.radius_m = settings.radius;
  hand.stretch = state.position + state.rest_offset_m - finger;
  if (pulls && state.free) hand.spring_N_m = settings.spring_N_m * state.stiffness / settings.world_per_device;
  bodies.step(now_ns, settings.period_s, hand);
}

// A snap holds the proxy like a surface that it is pulled from. One of a single point has no way along which it slides.
void BodyHand::holdBy(const SceneAt& scene, const ProxyState& state, const TickReport& report) {
  constexpr double kHolds = 1e3;  // friction of a point
  for (const ProxyContact& contact : report.contacts) {
    const bool sticks = state.rest_s >= accuracy::kStuck_s;
    held_by_.push({scene.instance(contact.primitive).key, contact.point, contact.normal, contact.static_friction,
                   contact.static_friction, !sticks});
  }
  std::uint32_t number = 0;
  const double pull_m = report.snap_pull_m.norm();
  if (!(pull_m > 0) || !state.snap.holds() || !scene.snapshot().find(state.snap.key, number)) return;
  const SnapSpec& snap = (*scene.snapshot().instances[number].snaps)[state.snap.number];
  const double friction = snap.points.size() == 1 && !snap.normal ? kHolds : 0;
  held_by_.push({state.snap.key, report.snap_point, report.snap_pull_m / pull_m, friction, friction, false});
}

void BodyHand::after(BodyWorld& bodies, const SceneAt& scene, const ProxyState& state, const TickReport& report,
                     const ProxySettings& settings, const Vec3& finger, bool pulls) {
  const bool touching = pulls && touches(state, report);
  held_by_.clear();
  if (touching) holdBy(scene, state, report);
  bodies.settle(touching ? objectForces(scene, settings, state, report, finger) : ObjectForces{}, settings.period_s);
}

}  // namespace hl
