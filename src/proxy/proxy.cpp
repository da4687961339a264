#include "proxy/proxy.h"

#include "base/finger_reach.h"
#include "proxy/adhesion.h"
#include "proxy/begin.h"
#include "proxy/carry.h"
#include "proxy/follow_deformation.h"
#include "proxy/spring_energy.h"
#include "proxy/tick.h"
#include "proxy/tolerances.h"
#include "proxy/yielding.h"

namespace hl {

namespace {

// Key of the object whose friction holds the proxy most strongly; it carries the proxy in the next tick. 0: none.
std::uint64_t carrierOf(const SceneAt& scene, const TickReport& report) {
  double most = 0;
  std::uint64_t key = 0;
  for (const ProxyContact& contact : report.contacts) {
    if (!contact.rough || contact.multiplier_m <= most) continue;
    most = contact.multiplier_m;
    key = scene.instance(contact.primitive).key;
  }
  return key;
}

double energyOf_J(const ProxyState& state, const ProxySettings& settings, const Vec3& finger) {
  const Vec3 gap_D = (state.position + state.rest_offset_m - finger) / settings.world_per_device;
  return springEnergy_J(settings.spring_N_m, state.stiffness, gap_D.squaredNorm());
}

// Moves the proxy with the moving objects, and the rest of its spring with their frames. Returns the energy change, J.
// This work is done by the objects, not by the rules of the surfaces, so no tank pays for it.
double carryAlong(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  const double before_J = energyOf_J(state, settings, finger);
  carry(state, scene, settings);
  followDeformation(state, scene, settings);
  yieldToFrames(state, scene, settings);
  const double moved_J = energyOf_J(state, settings, finger) - before_J;
  if (moved_J > 0) state.ledger.add(EnergyCause::kMoving, moved_J);
  return moved_J;
}

TickReport notRun(Ending why, const Vec3& target) {
  TickReport report;
  report.ending = why;
  report.target = target;
  return report;
}

// A tick in which a surface may adhere or yield. One that has left a surface that yields goes on to the finger itself.
TickReport tickTo(const Vec3& finger, ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                  int most_looks) {
  const Vec3 from = finger - state.rest_offset_m;
  TickReport report = state.adhering.empty() ? Tick(scene, settings, state, from, most_looks).run()
                                             : tickHeld(state, scene, settings, from, most_looks);
  if (state.rest_offset_m.isZero(0)) return report;
  report.target += state.rest_offset_m;
  if (!report.contacts.empty() || report.used_up_at > 0) return report;
  state.rest_offset_m = Vec3::Zero();
  const int looks = report.looks;
  const double injected_J = report.injected_J;
  report = Tick(scene, settings, state, finger, most_looks - looks).run();
  report.injected_J += injected_J;
  report.looks += looks;
  if (report.used_up_at > 0) report.used_up_at += looks;
  return report;
}

}  // namespace

ProxyState startProxy(const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  ProxyState state;
  if (canBeFinger(finger)) beginProxy(state, scene, settings, finger, StartSearch::kPlaces);
  return state;
}

TickReport tick(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                int most_looks) {
  if (!canBeFinger(finger)) return notRun(Ending::kInvalid, state.position);
  if (!state.free && !beginProxy(state, scene, settings, finger, convergence::kPlacesPerTick))
    return notRun(Ending::kUnplaced, finger);
  const double moved_J = carryAlong(state, scene, settings, finger);
  if (!canBeFinger(finger - state.rest_offset_m)) state.rest_offset_m = Vec3::Zero();
  TickReport report = tickTo(finger, state, scene, settings, most_looks);
  report.moved_J = moved_J;
  rememberDeformation(state, scene, settings, report, finger);
  rememberYielding(state, scene, settings, report, finger);
  state.time_ns = scene.time_ns();
  state.snapshot = scene.snapshot().number;
  state.carrier = carrierOf(scene, report);
  state.adhering = adheringOf(scene, settings, report);
  return report;
}

}  // namespace hl
