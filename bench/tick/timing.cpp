#include "tick/timing.h"

#include <algorithm>

#include "base/clock.h"

namespace hl::bench {

Timing PassTimes::middle() const {
  Timing timing;
  for (std::size_t i = 0; i < passes_.back().size(); ++i) {
    std::array<std::int64_t, kPasses> times{};
    for (std::size_t pass = 0; pass < times.size(); ++pass) times[pass] = passes_[pass][i];
    std::nth_element(times.begin(), times.begin() + kPasses / 2, times.end());
    timing.add(times[kPasses / 2]);
  }
  return timing;
}

Timing PassTimes::all() const {
  Timing timing;
  for (const auto& pass : passes_) {
    for (const std::int64_t time_ns : pass) timing.add(time_ns);
  }
  return timing;
}

TickTimes timeTicks(const Snapshot& snapshot, const ProxySettings& settings, const Path& path, std::size_t most) {
  TickTimes result;
  const std::size_t end = path.approach + std::min(most, path.fingers.size() - path.approach);
  for (int pass = 0; pass < kPasses; ++pass) {
    ProxyState state = startProxy(snapshot, settings, path.fingers[0]);
    ManyRecentPrimitives recent;
    result.capped = result.out_of_work = 0;
    for (std::size_t i = 1; i < end; ++i) {
      const std::int64_t start_ns = monotonicNow_ns();
      const TickReport report = tick(state, {snapshot, 0, recent}, settings, path.fingers[i]);
      const std::int64_t time_ns = monotonicNow_ns() - start_ns;
      if (i < path.approach) continue;
      result.times.add(pass, time_ns);
      result.capped += report.capped() ? 1 : 0;
      result.out_of_work += report.ending == Ending::kOutOfWork ? 1 : 0;
    }
  }
  return result;
}

}  // namespace hl::bench
