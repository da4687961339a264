// Pusher: what moves pushes the proxy. From one tick to the next time goes on by advances, each so far that nothing can
// have passed the proxy; after each it goes where its carrier takes it, and is pushed out of what has come too near.
//
//   objects that move   are swept in their own frame (rigid_sweep.h). The first that meets the proxy carries it from
//                       there on; where another meets it then, the two close in, and it goes on by small steps
//   meshes that deform  go by small steps (small_step.h)
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/pushed_proxy.h"

namespace hl {

/// For one time between two ticks. RT-safe.
class Pusher {
 public:
  /// From state.time_ns, where the proxy is at state.position, to `end_ns`.
  Pusher(const ProxyState& state, const Snapshot& snapshot, const ProxySettings& settings, std::int64_t end_ns);

  /// Where the proxy is in the end.
  Vec3 run();

 private:
  void sweep(int left);
  void step(int left);
  void goOnTo(std::int64_t time_ns);

  PushedProxy proxy_;
};

}  // namespace hl
