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

  LoopTotals& operator+=(const LoopTotals& more) {
    steps += more.steps;
    missed += more.missed;
    late_max_ns = std::max(late_max_ns, more.late_max_ns);
    for (std::size_t i = 0; i < duty.size(); ++i) duty[i] += more.duty[i];
    page_faults += more.page_faults;
    waits += more.waits;
    preempted += more.preempted;
    return *this;
  }
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
