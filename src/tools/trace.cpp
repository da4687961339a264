#include "tools/trace.h"

#include "base/clock.h"

namespace hl {

TraceTotals runTrace(const Snapshot& snapshot, const TraceSettings& settings, const std::vector<PathSample>& path,
                     const std::function<void(const TraceRow&)>& row) {
  TraceTotals totals;
  if (path.empty()) return totals;
  ProxySettings proxy = settings.proxy;
  ManyRecentPrimitives recent;
  ProxyState state = startProxy(snapshot, proxy, path.front().position);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3& finger = path[i].position;
    if (i > 0) proxy.period_s = path[i].t - path[i - 1].t;
    const std::int64_t start_ns = monotonicNow_ns();
    const TickReport report = tick(state, {snapshot, 0, recent}, proxy, finger);
    TraceRow out{};
    out.tick_ns = monotonicNow_ns() - start_ns;
    out.t = path[i].t;
    out.finger = finger;
    out.proxy = state.position;
    out.target = report.target;
    out.force = proxy.spring_N_m * (report.target - finger);
    out.contacts = static_cast<int>(report.contacts.size());
    out.iterations = report.iterations;
    out.injected_J = report.injected_J;
    row(out);
    ++totals.ticks;
    totals.ended.add(report.ending);
    totals.contacts += report.contacts.empty() ? 0 : 1;
  }
  totals.ledger = state.ledger;
  return totals;
}

}  // namespace hl
