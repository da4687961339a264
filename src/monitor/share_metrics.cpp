#include "monitor/share_metrics.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace hl {

namespace {

// A series may come once, and two servers may have one name for a few seconds: the longer time counts.
void writeTimes(MetricsText& out, const ShareView& view, double PeerView::*time_ms) {
  constexpr double kSecondsOfMs = 1e-3;
  std::map<std::string_view, double> longest_ms;
  for (const PeerView& peer : view.peers) {
    double& time = longest_ms[peer.name];
    time = std::max(time, peer.*time_ms);
  }
  for (const auto& [name, time] : longest_ms) out.sample(kSecondsOfMs * time, {{"server", name}});
}

void writePeers(MetricsText& out, const ShareView& view) {
  using enum MetricType;
  out.family("hl_share_round_trip_seconds", kGauge, "To another server and back, the fastest of the last seconds");
  writeTimes(out, view, &PeerView::round_trip_ms);
  out.family("hl_share_playout_seconds", kGauge, "How long after it was so what another server tells is shown");
  writeTimes(out, view, &PeerView::playout_ms);
}

std::string endOf(const ShareView& view) {
  return view.ended.empty() ? "" : "the world '" + view.world + "' is not shared: " + view.ended;
}

}  // namespace

void writeShareMetrics(MetricsText& out, const ShareView& view) {
  using enum MetricType;
  const ShareCounts& counts = view.counts;
  const auto total = [&](const char* name, const char* help, std::uint64_t count) {
    out.single(name, kCounter, help, static_cast<double>(count));
  };
  const auto now = [&](const char* name, const char* help, std::size_t count) {
    out.single(name, kGauge, help, static_cast<double>(count));
  };
  out.single("hl_share_running", kGauge, "1 while the server shares its world", view.ended.empty() ? 1 : 0);
  total("hl_share_starts_total", "Times that hl-share was started again, after it had ended", view.starts);
  now("hl_share_servers", "Other servers that are there", view.peers.size());
  now("hl_share_hands", "Hands of other servers", view.hands.size());
  now("hl_share_objects", "Objects of all servers", counts.items);
  now("hl_share_own_objects", "Of those the ones of which this server tells where they are", counts.own_items);
  now("hl_share_fetching", "Shapes and surfaces that are on their way to this server", counts.fetching);
  total("hl_share_fetched_bytes_total", "Of shapes and surfaces that have come", counts.fetched_bytes);
  total("hl_share_adopted_total", "Objects that were taken over from a lost server", counts.adopted);
  total("hl_share_returned_total", "Objects that were taken back by this server", counts.returned);
  total("hl_share_lost_claims_total", "Objects that another server had taken over as well", counts.lost_claims);
  total("hl_share_refused_total", "Packets that make no sense", counts.refused);
  total("hl_share_left_out_total", "Objects of other servers that there was no room for", counts.left_out);
  out.family("hl_share_pushes_total", kCounter, "Impulses on bodies of other servers");
  out.sample(static_cast<double>(counts.pushes_sent), {{"what", "sent"}});
  out.sample(static_cast<double>(counts.pushes_taken), {{"what", "taken"}});
  out.single("hl_share_join_seconds", kGauge, "From the start until all that was told first was here; 0: not yet",
             counts.join_s);
  writePeers(out, view);
}

MonitorCallbacks withShareMetrics(MonitorCallbacks monitor, ReadShare read) {
  if (!read) return monitor;
  monitor.fault = [own = std::move(monitor.fault), read] {
    std::string why = own();
    return why.empty() ? endOf(read()) : why;
  };
  monitor.metrics = [own = std::move(monitor.metrics), read = std::move(read)](MetricsText& out) {
    own(out);
    writeShareMetrics(out, read());
  };
  return monitor;
}

}  // namespace hl
