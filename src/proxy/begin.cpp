#include "proxy/begin.h"

#include "proxy/tolerances.h"

namespace hl {

bool beginProxy(ProxyState& state, const SceneAt& scene, const ProxySettings& settings, const Vec3& finger,
                int places) {
  const auto tolerance = Tolerances::of(settings.radius, scene.extent());
  state.free = state.start.look(scene, tolerance, finger, places, state.position);
  state.time_ns = scene.time_ns();
  state.snapshot = scene.snapshot().number;
  return state.free;
}

}  // namespace hl
