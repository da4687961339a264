#include "touch/body_loop.h"

namespace hl {

const BodyCommands& BodyLoop::takeCommands() {
  done_ = to_do_;
  to_do_.clear();
  return done_;
}

void BodyLoop::step(const Snapshot& scene, BodyWorld* bodies, std::int64_t now_ns, double period_s,
                    std::span<const HandAtBodies> hands) {
  takeCommands();
  if (bodies == nullptr) return events_.forget();
  bodies->act(done_);
  events_.begin(scene, *bodies);
  bodies->step(now_ns, period_s, hands);
  events_.end(now_ns, period_s, *bodies);
}

}  // namespace hl
