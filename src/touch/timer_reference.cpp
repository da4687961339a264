#include "touch/timer_reference.h"

#include "base/guarded_thread.h"
#include "base/realtime.h"
#include "touch/loop_parts.h"

namespace hl {

// What keeps a thread waiting differs from core to core: so it shares the servo's.
void TimerReference::start(double rate_Hz, int core) {
  running_ = true;
  thread_ = startThread("bare timer", [this, rate_Hz, core] {
    requestRealtime(kServoPriority, core);
    runPeriodic(periodOf_ns(rate_Hz), running_, counters_, [](std::int64_t) {});
  });
}

void TimerReference::stop() {
  if (running_.exchange(false)) thread_.join();
}

}  // namespace hl
