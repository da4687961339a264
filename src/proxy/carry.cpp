#include "proxy/carry.h"

#include "proxy/pusher.h"

namespace hl {

void carry(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  const Snapshot& snapshot = scene.snapshot();
  if (state.time_ns < snapshot.moves_until_ns && state.time_ns < scene.time_ns())
    state.position = Pusher(state, snapshot, settings, scene.time_ns()).run();
}

}  // namespace hl
