#include "touch/proxy_thread.h"

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "base/realtime.h"

namespace hl {

namespace {

constexpr int kProxyPriority = 70;  // SCHED_FIFO

}  // namespace

void ProxyThread::start() {
  running_ = true;
  thread_ = startThread("proxy", [this] { run(); });
}

void ProxyThread::stop() {
  if (running_.exchange(false)) thread_.join();
}

void ProxyThread::run() {
  requestRealtime(kProxyPriority, spareCore(1));
  runPeriodic(periodOf_ns(rate_Hz_), running_, counters_, [&](std::int64_t) {
    if (!parts_.ticker.onServo()) guarded([this] { tick(); });
  });
}

void ProxyThread::tick() {
  const std::int64_t now_ns = monotonicNow_ns();
  const ProxyCommands& commands = parts_.ticker.follow();
  parts_.exchange.finger_D.read(finger_D_);
  const SpringOfServo spring{parts_.live.stiffness_N_m(), parts_.live.ledger(), 1 / rate_Hz_,
                             parts_.exchange.makes_force.load(std::memory_order_relaxed)};
  const ProxyStep step = parts_.ticker.loop().step(now_ns, finger_D_, commands, spring);
  const std::int64_t work_ns = monotonicNow_ns() - now_ns;
  parts_.exchange.ticks.write({step.held, 1e-3f * static_cast<float>(work_ns)});
  parts_.ticker.done({now_ns, finger_D_, commands, spring}, step, now_ns, work_ns);
}

}  // namespace hl
