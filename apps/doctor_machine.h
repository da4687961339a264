// What a machine grants the loops: how late a timer is at each rate of a servo, priority, memory, a core.
#pragma once

#include <cstdint>
#include <vector>

#include "base/realtime.h"

namespace hl {

struct TimerResult {
  double rate_Hz = 0;
  std::uint64_t late_median_ns = 0, late_p999_ns = 0, late_max_ns = 0;
  std::uint64_t steps = 0, deadlines_missed = 0;
  bool holds = false;
};

struct MachineExamination {
  unsigned cores = 0;
  std::vector<TimerResult> timers;
  RealtimeGrant grant;

  double servoRate_Hz() const;  ///< the highest that it holds; 0: none
};

/// Takes a second for each rate.
MachineExamination examineMachine();
void print(const MachineExamination& machine);

}  // namespace hl
