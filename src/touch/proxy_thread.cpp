#include "touch/proxy_thread.h"

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "base/realtime.h"

namespace hl {

void ProxyThread::start() {
  thread_.start("proxy", [this] { run(); });
}

void ProxyThread::stop() { thread_.stop(); }

void ProxyThread::run() {
  requestRealtime(kProxyPriority, spareCore(1));
  runPeriodic(periodOf_ns(rate_Hz_), thread_.running(), counters_, [&](std::int64_t) {
    if (tick_.ticker().isTurnOf(Turn::kProxy)) guarded([this] { tick(); });
  });
}

void ProxyThread::tick() {
  const TickRequest& request = tick_.begin(monotonicNow_ns());
  tick_.end(tick_.ticker().loop().step(request.time_ns, request.finger_D, request.commands, request.spring));
}

}  // namespace hl
