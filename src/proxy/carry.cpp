#include "proxy/carry.h"

#include "proxy/pusher.h"

namespace hl {

void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  if (state.time_ns < scene.snapshot().moves_until_ns && state.time_ns < scene.time_ns())
    state.position = Pusher(state, scene, settings).run();
}

}  // namespace hl
