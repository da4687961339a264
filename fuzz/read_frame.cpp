#include "read_frame.h"

#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "proxy/proxy.h"
#include "server/decode_frame.h"

namespace hl::fuzz {

namespace {

SceneLimits smallLimits() {
  SceneLimits limits;
  limits.objects = 64;
  limits.primitives = 2000;
  limits.instances = 64;
  limits.texture_bytes = 1U << 16;
  limits.nesting = 8;
  return limits;
}

void require(bool holds) {
  if (!holds) std::abort();
}

// A few ticks through the middle of it: whatever the scene, the proxy stays finite and is never let in.
void touch(const Snapshot& snapshot) {
  ProxySettings settings;
  settings.radius = 0.01;
  settings.iteration_cap = 50;
  ProxyState state = startProxy(snapshot, settings, {0.5, 0.5, 0.5});
  for (int i = 0; i < 5; ++i) {
    tick(state, snapshot, settings, {0.5 - 0.2 * i, 0.5 - 0.21 * i, 0.5 - 0.19 * i});
    require(state.position.allFinite());
  }
}

}  // namespace

void readFrame(const proto::ClientMessage& message) {
  Uploads uploads;
  if (message.has_upload()) uploads[message.upload().id()] = message.upload().part();
  EditableScene scene(1, smallLimits());
  try {
    const DecodedFrame frame = decodeFrame(message.frame(), uploads, smallLimits(), [](double) {});
    scene.apply(frame.edit);
  } catch (const Error& error) {
    require(scene.placed().empty() && error.what()[0] != '\0');
    return;
  }
  touch(*makeSnapshot(followOn(scene.placed(), {}, 0, 0).instances));
}

}  // namespace hl::fuzz
