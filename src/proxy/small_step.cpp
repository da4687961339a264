#include "proxy/small_step.h"

#include <algorithm>

#include "geometry/closest_point.h"
#include "proxy/clear_place.h"

namespace hl {

namespace {

using convergence::kCloseIn;

// Time until which each deforming mesh stays on one transition.
std::int64_t oneWayUntil(const PushedProxy& proxy) {
  std::int64_t until_ns = proxy.end_ns();
  for (const std::uint32_t i : proxy.snapshot().deforming) {
    const std::int64_t next_ns = proxy.snapshot().instances[i].mesh_motion->last().begin_ns();
    if (proxy.now_ns < next_ns) until_ns = std::min(until_ns, next_ns);
  }
  return until_ns;
}

// Maximum motion of an object past the proxy until `until_ns`, m, without its deformation.
double wayOf_m(const PushedProxy& proxy, const Instance& instance, std::int64_t until_ns, double clearance) {
  const PoseSource& poses = instance.poses();
  if (!poses.moves()) return 0;
  const Pose now = poses.at(proxy.now_ns), end = poses.at(until_ns);
  const double turn = (end.rotation - now.rotation).norm();
  const double slide = (end.toWorld(now.toObject(proxy.position)) - proxy.position).norm();
  return convergence::kArcPerChord * (slide + turn * clearance);
}

// The fraction of the time until `until_ns` in which no part of a deforming mesh uses up more than kCloseIn of its
// distance from the proxy's centre, if the mesh also moves by `way_m` past it. Primitives that stay farther than (1 -
// kCloseIn) of a reach on their whole way are skipped.
double partUntilClose(const PushedProxy& proxy, const Instance& instance, std::int64_t until_ns, double way_m) {
  const MeshTransition* const way = instance.transitionAt(proxy.now_ns);
  if (way == nullptr) return 1;
  const double begin = way->part(proxy.now_ns), end = way->part(until_ns);
  const Vec3 place = instance.poses().at(proxy.now_ns).toObject(proxy.position);
  const double within = (1 - kCloseIn) * proxy.tolerance.reach + way_m;
  double part = 1;
  way->index(begin, end).overlap(place, within, [&](ElementId primitive) {
    proxy.at_end.countTest();
    const double distance = closestPoint(way->primitive(primitive, begin), place).distance;
    const double most = (end - begin) * way->length_m(primitive) + way_m;
    if (kCloseIn * distance < part * most) part = kCloseIn * distance / most;
  });
  return part;
}

// The fraction of the time until `until_ns` that a small step may take.
double freePart(const PushedProxy& proxy, std::int64_t until_ns) {
  const double clearance = clearanceAt(proxy.scene(), proxy.position, proxy.tolerance.reach);
  const Vec3 carried = proxy.carriedTo(until_ns);
  const double carried_m = (carried - proxy.position).norm();
  double part = carried_m > 0 ? std::min(1.0, kCloseIn * clearance / carried_m) : 1;
  proxy.forEachNear(carried, [&](std::uint32_t, const Instance& instance) {
    const double way_m = wayOf_m(proxy, instance, until_ns, clearance) + carried_m;
    if (way_m > 0) part = std::min(part, kCloseIn * clearance / way_m);
    part = std::min(part, partUntilClose(proxy, instance, until_ns, way_m));
  });
  return part;
}

}  // namespace

bool deformsNear(const PushedProxy& proxy) {
  const Snapshot& snapshot = proxy.snapshot();
  if (proxy.now_ns >= snapshot.deforms_until_ns) return false;
  const Box region = proxy.regionOf(proxy.carriedTo(proxy.end_ns()));
  return std::any_of(snapshot.deforming.begin(), snapshot.deforming.end(), [&](std::uint32_t i) {
    return !proxy.at_end.leavesOut(i) && snapshot.instances[i].transitionAt(proxy.now_ns) != nullptr &&
           snapshot.reach[i].meets(region);
  });
}

Advance smallStep(const PushedProxy& proxy, int left) {
  const std::int64_t until_ns = oneWayUntil(proxy);
  const auto left_ns = static_cast<double>(until_ns - proxy.now_ns);
  if (!(left_ns > 0)) return {proxy.now_ns, kNoInstance};
  const double part = std::max(freePart(proxy, until_ns), 1.0 / left);
  return {proxy.now_ns + std::max<std::int64_t>(1, static_cast<std::int64_t>(part * left_ns)), kNoInstance};
}

}  // namespace hl
