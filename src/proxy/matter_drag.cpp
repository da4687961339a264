#include "proxy/matter_drag.h"

#include <algorithm>

#include "proxy/spring_energy.h"

namespace hl {

MatterForce matterAround(const SceneAt& scene, const Vec3& position) {
  MatterForce most;
  for (const std::uint32_t number : scene.snapshot().matter) {
    const Instance& instance = scene.snapshot().instances[number];
    if (!instance.shape->source->resists()) continue;
    const Vec3 place_O = instance.poses().at(scene.time_ns()).toObject(position);
    const MatterForce there = instance.shape->source->matterAt(place_O);
    most.resistance_N = std::max(most.resistance_N, there.resistance_N);
    most.drag_Ns_m = std::max(most.drag_Ns_m, there.drag_Ns_m);
  }
  return most;
}

namespace {

// Past a soft surface the spring is K again, not K s: the proxy goes on to where K pulls as hard. The spring then holds
// s times its energy. Where a surface is in the way, all stays.
TickReport stiffened(const TickReport& report, const Vec3& finger, ProxyState& state, TickTo tick_to) {
  ProxyState there = state;
  const Vec3 place = finger - state.stiffness * (finger - state.position);
  TickReport further = tick_to(place, there, report.looks);
  further.work += report.work;
  if (there.touching) {
    TickReport stays = report;
    stays.work = further.work;
    stays.looks = further.looks;
    stays.used_up_at = further.used_up_at;
    return stays;
  }
  state = there;
  return further;
}

}  // namespace

TickReport tickInMatter(ProxyState& state, const ProxySettings& settings, const MatterForce& matter, const Vec3& finger,
                        TickTo tick_to) {
  const double spring_N_m = settings.spring_N_m * state.stiffness;
  const Vec3 gap = finger - state.position - state.yielding.offset_m;
  const double pull_N = spring_N_m * gap.norm() / settings.world_per_device;
  if (!(pull_N > 0)) return tick_to(finger, state, 0);
  const double harder = 1 + matter.drag_Ns_m / (settings.period_s * spring_N_m);
  const double part = std::max(0.0, 1 - matter.resistance_N / pull_N) / harder;
  const Vec3 place = finger - (1 - part) * gap;
  const double before_J = springEnergy_J(settings, state, finger);
  const auto tick_held = [&](const Vec3& goal, ProxyState& at, int looks) {
    const Vec3 from = at.position;
    const double stiffness = at.stiffness;
    const TickReport held = tick_to(goal, at, looks);
    if (at.touching) return held;
    at.stiffness = stiffness;  // what matter holds is pulled by the same spring
    return stiffness < 1 && at.position != from ? stiffened(held, finger, at, tick_to) : held;
  };
  TickReport report = tickToGoal(state, settings, finger, {place, before_J}, tick_held);
  for (ProxyContact& contact : report.contacts) contact.multiplier_m *= harder;
  const Vec3 rest = state.anchor();
  setHeldPull(state, finger, rest - finger - (report.contacts.empty() ? 0 : harder) * (rest - place), report);
  return report;
}

}  // namespace hl
