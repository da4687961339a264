// Trace: a scene felt along a recorded finger path, offline, on a virtual clock. The contract is docs/trace.md.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/csv_path.h"
#include "io/trace_row.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"
#include "touch/ending_counts.h"

namespace hl {

struct TraceSettings {
  /// Without a budget of work, as nothing waits for a row.
  TraceSettings() { proxy.work_cap = kNoWorkCap; }

  ProxySettings proxy;  ///< the period is taken from the path, row by row
};

struct TraceTotals {
  std::uint64_t ticks = 0;
  std::uint64_t contacts = 0;  ///< ticks that ended in contact
  EndingCounts ended;          ///< ticks by why they ended
  Ledger ledger;               ///< of the whole trace
  TracedWorld before, after;   ///< of the bodies, at the first and the last row
  std::uint64_t returned = 0;  ///< how often a body has left its room, and was put back to where it started
};

/// The names of the bodies that rows have, as TraceRow::bodies.
std::vector<std::string> tracedBodies(const Snapshot& snapshot);
/// The same of the joints, as TraceRow::joints.
std::vector<std::string> tracedJoints(const Snapshot& snapshot);

/// One tick per sample; the proxy starts at the first one. Calls `row` with each result in order.
TraceTotals runTrace(const Snapshot& snapshot, const TraceSettings& settings, std::span<const PathSample> path,
                     const std::function<void(const TraceRow&)>& row);

}  // namespace hl
