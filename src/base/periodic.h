// A periodic loop with absolute deadlines, and what it counts of itself.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "base/function_ref.h"

namespace hl {

/// Of the duty of a step, the part of its period that it took: up to so much each.
inline constexpr std::array<double, 7> kDutyBounds{0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0};

/// Counts of one periodic loop; written by the loop, read by anyone.
struct LoopCounters {
  std::atomic<std::uint64_t> steps{0};
  std::atomic<std::uint64_t> deadlines_missed{0};  ///< periods skipped because a step began a whole period late or more
  std::atomic<std::int64_t> late_max_ns{0};        ///< worst wake-up after its deadline
  /// Steps by duty; the last are those that took longer than a period.
  std::array<std::atomic<std::uint64_t>, kDutyBounds.size() + 1> duty{};
  // Of the thread since the loop began, as the kernel counts them; up to date once a second and when the loop has
  // ended.
  std::atomic<std::uint64_t> page_faults{0};
  std::atomic<std::uint64_t> waits{0};      ///< for anything else than the next deadline
  std::atomic<std::uint64_t> preempted{0};  ///< put aside for another thread
};

/// Calls step(scheduled_ns) every `period_ns` at absolute times until `running` is false.
/// An overrun skips whole periods and counts them; it never runs steps in a burst.
void runPeriodic(std::int64_t period_ns, const std::atomic<bool>& running, LoopCounters& counters,
                 FunctionRef<void(std::int64_t scheduled_ns)> step);

}  // namespace hl
