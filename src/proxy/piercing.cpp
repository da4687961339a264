#include "proxy/piercing.h"

#include <algorithm>

#include "proxy/surface.h"

namespace hl {

namespace {

double strengthOf_N(const SceneAt& scene, const ProxySettings& settings, PrimitiveId id) {
  return scene.instance(id).movesAsBody() ? 0 : constantOf(scene, settings.surfaces, id, Quantity::kStrength);
}

// What presses an object, as a length: times K s it is a force. Contacts that pull do not press.
Vec3 pressed_m(const TickReport& report, std::uint32_t instance) {
  Vec3 sum_m = Vec3::Zero();
  for (const ProxyContact& contact : report.contacts) {
    if (contact.primitive.instance == instance) sum_m += std::max(0.0, contact.multiplier_m) * contact.normal;
  }
  return sum_m;
}

bool overlaps(const SceneAt& scene, std::uint64_t key, const Vec3& position, double reach) {
  std::uint32_t number = 0;
  if (!scene.snapshot().find(key, number)) return false;
  bool near = false;
  scene.primitivesWithin(position, reach, [&](PrimitiveId id, const ClosestPoint&) { near |= id.instance == number; });
  return near;
}

PiercedObjects stillPierced(const ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  PiercedObjects still;
  const double touching = Tolerances::of(settings.radius, scene.extent()).touching;
  for (const std::uint64_t key : state.pierced) {
    if (overlaps(scene, key, state.position, touching)) still.push(key);
  }
  return still;
}

// Of several contacts with an object the weakest decides.
void addPierced(const SceneAt& scene, const ProxySettings& settings, const TickReport& report, double newton_per_m,
                PiercedObjects& pierced) {
  for (const ProxyContact& contact : report.contacts) {
    const double strength_N = strengthOf_N(scene, settings, contact.primitive);
    if (!(strength_N > 0)) continue;
    const double force_N = newton_per_m * pressed_m(report, contact.primitive.instance).norm();
    if (!(force_N > strength_N)) continue;
    const std::uint64_t key = scene.instance(contact.primitive).key;
    if (std::find(pierced.begin(), pierced.end(), key) == pierced.end()) pierced.push(key);
  }
}

}  // namespace

void rememberPiercing(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                      const TickReport& report) {
  if (state.pierced.empty() && report.contacts.empty()) return;
  PiercedObjects pierced = state.pierced.empty() ? PiercedObjects{} : stillPierced(state, scene, settings);
  const double newton_per_m = settings.spring_N_m * state.stiffness / settings.world_per_device;
  addPierced(scene, settings, report, newton_per_m, pierced);
  if (std::equal(pierced.begin(), pierced.end(), state.pierced.begin(), state.pierced.end())) return;
  state.pierced = pierced;
  state.cache = {};  // it was of another scene
  state.adhering.clear();
}

}  // namespace hl
