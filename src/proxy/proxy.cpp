#include "proxy/proxy.h"

#include "base/finger_reach.h"
#include "proxy/adhesion.h"
#include "proxy/begin.h"
#include "proxy/carry.h"
#include "proxy/changed_stiffness.h"
#include "proxy/follow_deformation.h"
#include "proxy/leave_matter.h"
#include "proxy/matter_drag.h"
#include "proxy/piercing.h"
#include "proxy/snapping.h"
#include "proxy/spring_energy.h"
#include "proxy/tick.h"
#include "proxy/tolerances.h"
#include "proxy/yielding.h"

namespace hl {

namespace {

// Key of the object whose friction holds the proxy most strongly, or else of its snap; it carries the proxy in the next
// tick. 0: none.
std::uint64_t carrierOf(const SceneAt& scene, const TickReport& report, const HeldSnap& snap) {
  double most = 0;
  std::uint64_t key = snap.key;
  for (const ProxyContact& contact : report.contacts) {
    if (!contact.holds_tangentially || contact.multiplier_m <= most) continue;
    most = contact.multiplier_m;
    key = scene.instance(contact.primitive).key;
  }
  return key;
}

// Moves the proxy with the moving objects, the rest of its spring with their frames, and changes its stiffness with
// that of the surfaces. Returns the energy change, J. This work is done by the objects, not by the rules of the
// surfaces, so no tank pays for it.
double carryAlong(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  const double before_J = springEnergy_J(settings, state, finger);
  followStiffness(state, scene, settings);
  carry(state, scene, settings);
  leaveMatter(state, scene, settings, finger);
  followDeformation(state, scene, settings);
  yieldToFrames(state, scene, settings);
  const double moved_J = springEnergy_J(settings, state, finger) - before_J;
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
TickReport tickYielding(const Vec3& finger, ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                        int most_looks) {
  const Vec3 from = finger - state.yielding.offset_m;
  TickReport report = state.adhering.empty() ? Tick(scene, settings, state, from, most_looks).run()
                                             : tickAdhering(state, scene, settings, from, most_looks);
  if (state.yielding.offset_m.isZero(0)) return report;
  report.target += state.yielding.offset_m;
  if (!report.contacts.empty() || report.used_up_at > 0) return report;
  state.yielding.dropOffset();
  const int looks = report.looks;
  const double injected_J = report.injected_J;
  report = Tick(scene, settings, state, finger, most_looks - looks).run();
  report.injected_J += injected_J;
  report.addEarlierLooks(looks);
  return report;
}

// A tick in which a snap may take the proxy, hold it or let go of it, or matter may hold it back.
TickReport tickSnappedOrInMatter(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                                 const Vec3& finger, int most_looks) {
  const auto tick_to = [&](const Vec3& goal, ProxyState& at, int looks) {
    TickReport report = tickYielding(goal, at, scene, settings, most_looks - looks);
    report.addEarlierLooks(looks);
    return report;
  };
  const bool was_held = state.snap.holds();
  const bool snaps = was_held || !scene.snapshot().snaps.empty();
  const std::optional<Vec3> goal = snaps ? followSnap(state, scene, settings, finger) : std::nullopt;
  if (goal) return tickSnapped(state, settings, finger, *goal, tick_to);
  if (was_held) return tickReleased(state, finger, tick_to);
  const MatterForce matter = matterAround(scene, state.position);
  return matter.acts() ? tickInMatter(state, settings, matter, finger, tick_to) : tick_to(finger, state, 0);
}

// A tick in the scene that the proxy has not pierced.
TickReport tickUnpierced(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                         int most_looks) {
  if (!state.free && !beginProxy(state, scene, settings, finger, convergence::kPlacesPerTick))
    return notRun(Ending::kUnplaced, finger);
  const double shared_J = sharePull(state, scene, settings, finger);
  const double moved_J = carryAlong(state, scene, settings, finger);
  if (!canBeFinger(finger - state.yielding.offset_m)) state.yielding.dropOffset();
  TickReport report = tickSnappedOrInMatter(state, scene, settings, finger, most_looks);
  report.moved_J = moved_J;
  report.injected_J += shared_J;
  const Vec3 aim = finger + report.held_pull_m;  // what the contacts hold the proxy from
  rememberDeformation(state, scene, settings, report, aim);
  rememberYielding(state, scene, settings, report, aim);
  rememberStiffness(state, scene, settings, report);
  state.time_ns = scene.time_ns();
  state.snapshot = scene.snapshot().number;
  state.carrier = carrierOf(scene, report, state.snap);
  if (!report.stayed) state.adhering = adheringOf(scene, settings, report);
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
  const TickReport report = state.pierced.empty()
                                ? tickUnpierced(state, scene, settings, finger, most_looks)
                                : tickUnpierced(state, SceneAt(scene, {state.pierced.begin(), state.pierced.size()}),
                                                settings, finger, most_looks);
  rememberPiercing(state, scene, settings, report);
  rememberMatter(state, scene);
  return report;
}

}  // namespace hl
