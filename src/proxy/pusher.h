// Pusher: moves the proxy with the moving objects from one tick to the next. Time advances in steps, each so short that
// nothing can pass the proxy. In each step the proxy moves with its carrier, and is then pushed out of objects that
// have come too near.
//
//   rigid objects       are swept in their own frame (rigid_sweep.h). The first one that meets the proxy becomes its
//                       carrier. If another object meets a proxy with a carrier, the two close in on it, and time
//                       advances by small steps
//   deforming meshes    small steps (small_step.h)
#pragma once

#include "proxy/proxy_state.h"
#include "proxy/pushed_proxy.h"

namespace hl {

/// For one interval between two ticks. RT-safe.
class Pusher {
 public:
  /// From state.time_ns, with the proxy at state.position, to the time of `scene`, which must outlive it.
  Pusher(const ProxyState& state, const SceneAt& scene, const ProxySettings& settings);

  /// Returns the position of the proxy then.
  Vec3 run();

 private:
  void sweep(int left);
  void step(int left);
  void goOnTo(std::int64_t time_ns);

  PushedProxy proxy_;
};

}  // namespace hl
