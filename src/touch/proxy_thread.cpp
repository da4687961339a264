#include "touch/proxy_thread.h"

#include "base/clock.h"
#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "base/realtime.h"

namespace hl {

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
    if (tick_.ticker().isTurnOf(Turn::kProxy)) guarded([this] { tick(); });
  });
}

void ProxyThread::tick() {
  const TickRequest& request = tick_.begin(monotonicNow_ns());
  tick_.end(tick_.ticker().loop().step(request.time_ns, request.finger_D, request.commands, request.spring));
}

}  // namespace hl
