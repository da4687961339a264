// ProxyThread: the second loop, at its own fixed rate: finger -> tick -> contacts for the servo. It ticks only while
// ticks do not fit in a servo step (loop_chooser.h).
#pragma once

#include <atomic>
#include <thread>

#include "touch/loop_parts.h"
#include "touch/loop_totals.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread; totals(): any thread.
class ProxyThread {
 public:
  ProxyThread(const LoopParts& parts, double rate_Hz) : parts_(parts), rate_Hz_(rate_Hz) {}
  ~ProxyThread() { stop(); }
  void start();
  void stop();  ///< safe to call twice
  LoopTotals totals() const { return totalsOf(counters_); }

 private:
  void run();
  void tick();

  LoopParts parts_;
  const double rate_Hz_;
  Vec3 finger_D_ = Vec3::Zero();
  LoopCounters counters_;
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace hl
