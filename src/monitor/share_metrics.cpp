#include "monitor/share_metrics.h"

#include <string>
#include <utility>

namespace hl {

namespace {

void writePeers(MetricsText& out, const ShareView& view) {
  using enum MetricType;
  constexpr double kSecondsOfMs = 1e-3;
  out.family("hl_share_round_trip_seconds", kGauge, "To another server and back, the fastest of the last seconds");
  for (const PeerView& peer : view.peers) out.sample(kSecondsOfMs * peer.round_trip_ms, {{"server", peer.name}});
  out.family("hl_share_playout_seconds", kGauge, "How long after it was so what another server tells is shown");
  for (const PeerView& peer : view.peers) out.sample(kSecondsOfMs * peer.playout_ms, {{"server", peer.name}});
}

std::string endOf(const ShareView& view) {
  return view.ended.empty() ? "" : "the world '" + view.world + "' is shared no more: " + view.ended;
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
