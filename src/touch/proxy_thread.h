// ProxyThread: the second loop, at its own fixed rate: finger -> tick -> contacts for the servo. It ticks only while
// ticks do not fit in a servo step (loop_chooser.h).
#pragma once

#include "base/guarded_thread.h"
#include "touch/loop_totals.h"
#include "touch/tick_beside.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; totals(): any thread.
class ProxyThread {
 public:
  ProxyThread(const LoopParts& parts, double rate_Hz) : tick_(parts, rate_Hz), rate_Hz_(rate_Hz) {}
  ~ProxyThread() { stop(); }
  void start();
  void stop();  ///< safe to call twice
  LoopTotals totals() const { return totalsOf(counters_); }

 private:
  void run();
  void tick();

  TickBeside tick_;
  const double rate_Hz_;
  LoopCounters counters_;
  LoopThread thread_;
};

}  // namespace hl
