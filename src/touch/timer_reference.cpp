#include "touch/timer_reference.h"

#include "base/realtime.h"
#include "touch/loop_parts.h"

namespace hl {

// What keeps a thread waiting differs from core to core: so it shares the servo's.
void TimerReference::start(double rate_Hz, int core) {
  thread_.start("bare timer", [this, rate_Hz, core] {
    requestRealtime(kServoPriority, core);
    runPeriodic(periodOf_ns(rate_Hz), thread_.running(), counters_, [](std::int64_t) {});
  });
}

void TimerReference::stop() { thread_.stop(); }

}  // namespace hl
