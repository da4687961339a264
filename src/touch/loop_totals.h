// What a loop has counted since its start.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/periodic.h"

namespace hl {

/// See LoopCounters.
struct LoopTotals {
  std::uint64_t steps = 0, missed = 0;
  std::int64_t late_max_ns = 0;
  std::array<std::uint64_t, kDutyBounds.size() + 1> duty{};
  std::uint64_t page_faults = 0, waits = 0, preempted = 0;
};

inline LoopTotals totalsOf(const LoopCounters& counters) {
  LoopTotals totals{counters.steps.load(), counters.deadlines_missed.load(), counters.late_max_ns.load()};
  std::copy(counters.duty.begin(), counters.duty.end(), totals.duty.begin());
  totals.page_faults = counters.page_faults.load();
  totals.waits = counters.waits.load();
  totals.preempted = counters.preempted.load();
  return totals;
}

}  // namespace hl
