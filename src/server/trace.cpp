#include "server/trace.h"

#include "base/clock.h"

namespace hl {

TraceTotals runTrace(const Snapshot& snapshot, const TraceSettings& settings, const std::vector<PathSample>& path,
                     const std::function<void(const TraceRow&)>& row) {
  TraceTotals totals;
  if (path.empty()) return totals;
  ProxyState state = startProxy(snapshot, settings.proxy, path.front().position);
  for (const PathSample& sample : path) {
    const Vec3& finger = sample.position;
    const double before = (state.position - finger).squaredNorm();
    const std::int64_t start_ns = monotonicNow_ns();
    const TickReport report = tick(state, snapshot, settings.proxy, finger);
    TraceRow out{};
    out.tick_ns = monotonicNow_ns() - start_ns;
    out.t = sample.t;
    out.finger = finger;
    out.proxy = state.position;
    out.target = settings.surface == 1 ? state.position : Vec3(finger + settings.surface * (state.position - finger));
    out.force = settings.stiffness_N_m * (out.target - finger);
    out.contacts = static_cast<int>(report.contacts.size());
    out.iterations = report.iterations;
    // What the move of the proxy did to the spring's energy 1/2 K s |proxy - finger|^2.
    out.injected_J =
        0.5 * settings.stiffness_N_m * settings.surface * ((state.position - finger).squaredNorm() - before);
    row(out);
    ++totals.ticks;
    totals.capped += report.capped ? 1 : 0;
    totals.contacts += report.contacts.empty() ? 0 : 1;
  }
  return totals;
}

}  // namespace hl
