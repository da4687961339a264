#include "proxy/snapping.h"

#include <algorithm>
#include <limits>

#include "base/finger_reach.h"
#include "proxy/goal_tick.h"
#include "proxy/spring_energy.h"

namespace hl {

namespace {

SnapPoint nearestTo(const Vec3& finger, const SceneAt& scene, const Instance& instance, const SnapSpec& snap) {
  const Pose pose = instance.poses().at(scene.time_ns());
  const Vec3 finger_O = pose.toObject(finger);
  SnapPoint nearest = nearestOn(snap.points, snap.normal, finger_O);
  // By the way to it, whose rounding is that of a small number.
  nearest.point = finger + pose.turnToWorld(nearest.point - finger_O);
  nearest.axis = pose.turnToWorld(nearest.axis);
  return nearest;
}

// Null: there is no such snap in the scene.
const SnapSpec* find(const HeldSnap& held, const SceneAt& scene, std::uint32_t& instance) {
  if (!held.holds() || !scene.snapshot().find(held.key, instance)) return nullptr;
  const auto& snaps = scene.snapshot().instances[instance].snaps;
  return snaps && held.number < snaps->size() ? &(*snaps)[held.number] : nullptr;
}

// R, m of the world, from which the spring pulls by more than the snap holds.
double releaseDistance_m(const SnapSpec& snap, const ProxySettings& settings) {
  const double spring_N_m = settings.springInWorld_N_m();
  return spring_N_m > 0 ? snap.release_N / spring_N_m : std::numeric_limits<double>::infinity();
}

std::optional<Vec3> goOn(const HeldSnap& held, const SceneAt& scene, const ProxySettings& settings,
                         const Vec3& finger) {
  std::uint32_t instance = 0;
  const SnapSpec* const snap = find(held, scene, instance);
  if (snap == nullptr) return {};
  const Vec3 point = nearestTo(finger, scene, scene.snapshot().instances[instance], *snap).point;
  if ((point - finger).norm() > releaseDistance_m(*snap, settings)) return {};
  return point;
}

std::optional<Vec3> capture(HeldSnap& held, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger) {
  std::optional<Vec3> goal;
  double least_m = std::numeric_limits<double>::infinity();
  for (const PlacedSnap& placed : scene.snapshot().snaps) {
    const Instance& instance = scene.snapshot().instances[placed.instance];
    const SnapSpec& snap = (*instance.snaps)[placed.number];
    const Vec3 point = nearestTo(finger, scene, instance, snap).point;
    const double distance_m = (point - finger).norm();
    const bool reached = distance_m <= std::min(snap.capture_m, releaseDistance_m(snap, settings));
    if (!reached || distance_m >= least_m) continue;
    least_m = distance_m;
    held = {instance.key, placed.number};
    goal = point;
  }
  return goal;
}

// Where the spring is fixed before the tick.
Vec3 restOf(const ProxyState& state, const Vec3& finger) { return state.touching ? state.anchor() : finger; }

// The part of the way to `goal` for which the tank pays.
Vec3 affordable(const ProxyState& state, const ProxySettings& settings, const Vec3& finger, const Vec3& goal) {
  const Vec3 from = restOf(state, finger);
  const double scale = settings.world_per_device;
  const double per_square_J = springEnergy_J(settings.spring_N_m, state.stiffness, 1 / (scale * scale));
  if (!(per_square_J > 0)) return goal;
  const double part = partWithin(from - finger, goal - from, state.ledger.budget_J(settings.ledger) / per_square_J);
  return part < 1 ? Vec3(from + part * (goal - from)) : goal;
}

}  // namespace

std::optional<SnapPoint> heldPoint(const HeldSnap& held, const SceneAt& scene, const Vec3& finger) {
  std::uint32_t instance = 0;
  const SnapSpec* const snap = find(held, scene, instance);
  if (snap == nullptr) return {};
  return nearestTo(finger, scene, scene.snapshot().instances[instance], *snap);
}

std::optional<Vec3> followSnap(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                               const Vec3& finger) {
  const bool held = state.snap.holds();
  const std::optional<Vec3> goal =
      held ? goOn(state.snap, scene, settings, finger) : capture(state.snap, scene, settings, finger);
  if (goal && canBeFinger(*goal)) return goal;
  state.snap = {};
  return {};
}

TickReport tickSnapped(ProxyState& state, const ProxySettings& settings, const Vec3& finger, const Vec3& goal,
                       TickTo tick_to) {
  const Vec3 aim = affordable(state, settings, finger, goal);
  const double before_J = state.touching ? springEnergy_J(settings, state, finger) : 0;
  TickReport report = tickToGoal(state, settings, finger, {aim, before_J}, tick_to);
  if (report.ending == Ending::kNoEnergy && !state.touching) {
    state.snap = {};
    return tick_to(finger, state, report.looks);
  }
  const Vec3 held = report.contacts.empty() ? state.anchor() : aim;
  setHeldPull(state, finger, held - finger, report);
  report.snap_point = goal;
  return report;
}

TickReport tickReleased(ProxyState& state, const Vec3& finger, TickTo tick_to) {
  TickReport report = tick_to(finger, state, 0);
  if (!state.touching) state.ledger.refill(std::max(0.0, -report.injected_J));
  return report;
}

}  // namespace hl
