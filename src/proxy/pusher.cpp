#include "proxy/pusher.h"

#include "proxy/push_out.h"
#include "proxy/rigid_sweep.h"
#include "proxy/small_step.h"

namespace hl {

Pusher::Pusher(const ProxyState& state, const SceneAt& scene, const ProxySettings& settings)
    : proxy_{scene, Tolerances::of(settings.radius, scene.extent()), state.time_ns, state.position,
             movingInstance(scene, state.carrier)} {}

Vec3 Pusher::run() {
  for (int left = convergence::kMaxCarrySteps; left > 0 && proxy_.now_ns < proxy_.end_ns(); --left)
    deformsNear(proxy_) ? step(left) : sweep(left);
  goOnTo(proxy_.end_ns());
  return proxy_.position;
}

void Pusher::sweep(int left) {
  const Advance free = rigidSweep(proxy_);
  goOnTo(free.until_ns);
  if (free.met == kNoInstance) return;
  const bool carries = proxy_.carrier == kNoInstance && proxy_.snapshot().instances[free.met].poses().moves();
  proxy_.carrier = carries ? free.met : kNoInstance;
  if (!carries) step(left);
}

void Pusher::step(int left) { goOnTo(smallStep(proxy_, left).until_ns); }

void Pusher::goOnTo(std::int64_t time_ns) {
  if (time_ns <= proxy_.now_ns) return;
  proxy_.position = proxy_.carriedTo(time_ns);
  proxy_.now_ns = time_ns;
  proxy_.position = pushedOut(proxy_.scene(), proxy_.tolerance, proxy_.position);
}

}  // namespace hl
