// TimerReference: a thread that only waits for its next deadline, at the servo's rate, priority and core: what the
// machine's own hiccups do to a loop.
#pragma once

#include "base/guarded_thread.h"
#include "touch/loop_totals.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; totals(): any thread.
class TimerReference {
 public:
  TimerReference() = default;
  ~TimerReference() { stop(); }
  void start(double rate_Hz, int core);
  void stop();  ///< safe to call twice
  LoopTotals totals() const { return totalsOf(counters_); }

 private:
  LoopCounters counters_;
  LoopThread thread_;
};

}  // namespace hl
