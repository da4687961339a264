#include "tick/timing.h"

#include <algorithm>

#include "base/clock.h"

namespace hl::bench {

TickTimes timeTicks(const Snapshot& snapshot, const ProxySettings& settings, const Path& path, std::size_t most) {
  TickTimes result;
  ProxyState state = startProxy(snapshot, settings, path.fingers[0]);
  RecentPrimitives recent;
  const std::size_t end = path.approach + std::min(most, path.fingers.size() - path.approach);
  for (std::size_t i = 1; i < end; ++i) {
    const std::int64_t start_ns = monotonicNow_ns();
    const TickReport report = tick(state, {snapshot, 0, recent}, settings, path.fingers[i]);
    const std::int64_t time_ns = monotonicNow_ns() - start_ns;
    if (i < path.approach) continue;
    result.times.add(time_ns);
    result.capped += report.capped ? 1 : 0;
  }
  return result;
}

}  // namespace hl::bench
