#include "proxy/rigid_sweep.h"

#include <algorithm>
#include <cmath>

#include "geometry/queries.h"

namespace hl {

namespace {

// Time until which each object nearby stays on one screw and turns little enough for a straight sweep.
std::int64_t straightUntil(const PushedProxy& proxy) {
  std::int64_t until_ns = proxy.end_ns();
  proxy.forEachNear(proxy.position, [&](std::uint32_t, const Instance& instance) {
    until_ns = instance.poses().straightUntil(proxy.now_ns, until_ns, accuracy::kMaxTurn_rad);
  });
  return until_ns;
}

struct Meeting {
  double part = 2;  // fraction of the time until `until_ns`; above 1: no meeting
  std::uint32_t instance = kNoInstance;
};

Meeting firstMeeting(const PushedProxy& proxy, std::int64_t until_ns) {
  const Vec3 carried = proxy.carriedTo(until_ns);
  const double met_m = accuracy::kMetAt * proxy.tolerance.reach;
  Meeting first;
  proxy.forEachNear(carried, [&](std::uint32_t i, const Instance& instance) {
    if (i == proxy.carrier || (!instance.poses().moves() && proxy.carrier == kNoInstance)) return;
    const Vec3 from = instance.poses().at(proxy.now_ns).toObject(proxy.position);
    const Vec3 to = instance.poses().at(until_ns).toObject(carried);
    const Shape& shape = *instance.shape;
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& {
      proxy.at_end.countTest();
      return last = shape.primitive(id);
    };
    FirstImpact hit;
    if (!firstImpact(*shape.index, read, from, to - from, met_m, -1, hit)) return;
    if (hit.impact.t < first.part || (hit.impact.t == first.part && i < first.instance)) first = {hit.impact.t, i};
  });
  return first;
}

}  // namespace

Advance rigidSweep(const PushedProxy& proxy) {
  const std::int64_t until_ns = straightUntil(proxy);
  const Meeting meeting = firstMeeting(proxy, until_ns);
  if (meeting.part > 1) return {until_ns, kNoInstance};
  const auto way_ns = static_cast<double>(until_ns - proxy.now_ns);
  return {proxy.now_ns + static_cast<std::int64_t>(std::floor(meeting.part * way_ns)), meeting.instance};
}

}  // namespace hl
