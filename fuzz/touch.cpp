#include "touch.h"

#include <cmath>

#include "proxy/field_forces.h"
#include "proxy/proxy.h"

namespace hl::fuzz {

namespace {

// Where the scene is and how large, as far as a finger could find out.
struct Place {
  Vec3 centre = Vec3::Zero();
  double size = 1;
};

Place placeOf(const Box& bounds) {
  constexpr double kSmallest = 1e-6, kFarthest = 1e6;
  if (bounds.empty()) return {};
  const Place place{0.5 * (bounds.min + bounds.max), bounds.size().norm()};
  const bool within_reach = place.centre.norm() < kFarthest && place.size < kFarthest;
  if (!within_reach) return {};
  return place.size > kSmallest ? place : Place{place.centre, kSmallest};
}

}  // namespace

void touch(const Snapshot& snapshot) {
  constexpr int kTicks = 9;
  const Place place = placeOf(snapshot.bounds);
  const Vec3 begin = place.size * Vec3(0.3, 0.5, 0.4);
  ProxySettings settings;
  settings.radius = 0.02 * place.size;
  settings.iteration_cap = 50;
  ProxyState state = startProxy({snapshot, 0}, settings, place.centre + begin);
  for (int i = 0; i < kTicks; ++i) {
    const Vec3 finger = place.centre + (1 - 2.0 * i / (kTicks - 1)) * begin;
    const TickReport report = tick(state, {snapshot, i * 1'000'000}, settings, finger);
    require(report.valid() && state.position.allFinite() && report.target.allFinite());
    require(fieldForces({snapshot, i * 1'000'000}, finger).force_N.allFinite());
  }
}

}  // namespace hl::fuzz
