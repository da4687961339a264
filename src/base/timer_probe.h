// What a thread that only waits for its next deadline gets of this machine: how late it is.
#pragma once

#include <chrono>

#include "base/histogram.h"
#include "base/periodic.h"
#include "base/realtime.h"

namespace hl {

struct TimerProbe {
  double rate_Hz = 0;
  RealtimeGrant grant;
  LoopCounters counters;
  Histogram late;  ///< wake-ups after their deadlines

  /// Late by less than half a period in 999 of 1000 steps: the other half is for the step.
  bool holds() const { return static_cast<double>(late.percentile_ns(0.999)) < 0.5e9 / rate_Hz; }

  /// Runs a loop for so long, on a thread of its own with the priority of a servo. Setup only.
  void run(std::chrono::milliseconds duration);
};

}  // namespace hl
