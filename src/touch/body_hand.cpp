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

void BodyHand::after(BodyWorld& bodies, const SceneAt& scene, const ProxyState& state, const TickReport& report,
                     const ProxySettings& settings, const Vec3& finger, bool pulls) {
  const bool touching = pulls && touches(state, report);
  held_by_.clear();
  if (touching) {
    for (const ProxyContact& contact : report.contacts) {
      const bool sticks = state.rest_s >= accuracy::kStuck_s;
      held_by_.push({scene.instance(contact.primitive).key, contact.point, contact.normal, contact.static_friction,
                     contact.static_friction, !sticks});
    }
  }
  bodies.settle(touching ? objectForces(scene, settings, state, report, finger) : ObjectForces{}, settings.period_s);
}

}  // namespace hl
