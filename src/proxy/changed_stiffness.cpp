#include "proxy/changed_stiffness.h"

#include <algorithm>
#include <optional>

#include "proxy/mean_stiffness.h"
#include "proxy/surface.h"

namespace hl {

namespace {

// None: it is not there any more.
std::optional<double> stiffnessNow(const HeldSurface& held, const SceneAt& scene, const ProxySettings& settings) {
  PrimitiveId id{0, held.element};
  if (!scene.snapshot().find(held.key, id.instance) || held.element >= scene.shape(id).count()) return std::nullopt;
  return Surface(scene, settings.surfaces, id).stiffness(held.weights);
}

}  // namespace

void followStiffness(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  const bool same = state.snapshot == scene.snapshot().number && state.held.said == settings.surfaces.stiffness;
  if (same || state.held.surfaces.empty()) return;
  MeanStiffness before, now;
  FixedVector<double, kMaxActive> changed;
  for (const HeldSurface& held : state.held.surfaces) {
    const std::optional<double> stiffness = stiffnessNow(held, scene, settings);
    if (!stiffness) return;
    before.add(held.multiplier_m, held.stiffness);
    now.add(held.multiplier_m, *stiffness);
    changed.push(*stiffness);
  }
  if (before.value() == now.value()) return;
  for (std::size_t i = 0; i < state.yielding.contacts.size(); ++i) state.yielding.contacts[i].stiffness = changed[i];
  if (!state.yielding.contacts.empty()) return;  // yieldToFrames() follows these
  // What the last ticks have left of the stiffness, for want of energy, stays the same part of it.
  state.stiffness = before.value() > 0 ? std::min(1.0, state.stiffness * now.value() / before.value()) : now.value();
}

void rememberStiffness(ProxyState& state, const SceneAt& scene, const ProxySettings& settings,
                       const TickReport& report) {
  state.held.said = settings.surfaces.stiffness;
  state.held.surfaces.clear();
  for (const ProxyContact& contact : report.contacts)
    state.held.surfaces.push({scene.instance(contact.primitive).key, contact.primitive.element, contact.weights,
                              contact.multiplier_m, contact.stiffness});
}

}  // namespace hl
