// What a thread needs to be on time: priority, locked memory, and a periodic loop with absolute deadlines.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "base/function_ref.h"

namespace hl {

/// What the machine granted; `why` is one plain sentence for each thing refused, empty when all was granted.
struct RealtimeGrant {
  bool fifo = false;           ///< the calling thread runs under SCHED_FIFO
  bool memory_locked = false;  ///< mlockall succeeded
  std::string why;
};

/// Asks for SCHED_FIFO at `priority` (1..99) and locked memory for the calling thread. Setup only.
RealtimeGrant requestRealtime(int priority);

/// Counts of one periodic loop; written by the loop, read by anyone.
struct LoopCounters {
  std::atomic<std::uint64_t> steps{0};
  std::atomic<std::uint64_t> deadlines_missed{0};  ///< periods skipped because a step began a whole period late or more
  std::atomic<std::int64_t> late_max_ns{0};        ///< worst wake-up after its deadline
};

/// Calls step(scheduled_ns) every `period_ns` at absolute times until `running` is false.
/// An overrun skips whole periods and counts them; it never runs steps in a burst.
void runPeriodic(std::int64_t period_ns, const std::atomic<bool>& running, LoopCounters& counters,
                 FunctionRef<void(std::int64_t scheduled_ns)> step);

}  // namespace hl
