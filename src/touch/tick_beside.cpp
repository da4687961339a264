#include "touch/tick_beside.h"

#include "base/clock.h"

namespace hl {

const TickRequest& TickBeside::begin(std::int64_t now_ns) {
  request_.time_ns = now_ns;
  request_.commands = parts_.ticker.follow();
  parts_.exchange.finger_D.read(request_.finger_D);
  request_.spring = {parts_.live.stiffness_N_m(), parts_.live.ledger(), period_s_,
                     parts_.exchange.makes_force.load(std::memory_order_relaxed)};
  return request_;
}

void TickBeside::end(const ProxyStep& step) {
  const std::int64_t work_ns = monotonicNow_ns() - request_.time_ns;
  parts_.exchange.ticks.write({step.held, 1e-3f * static_cast<float>(work_ns)});
  parts_.ticker.done(request_, &step, request_.time_ns, work_ns);
}

}  // namespace hl
