#include "http/traffic.h"

namespace hl {

void writeTraffic(MetricsText& out, const ServerCounts& counts) {
  const Traffic& traffic = counts.traffic;
  const auto number = [](auto count) { return static_cast<double>(count); };
  using enum MetricType;
  out.single("hl_connections", kGauge, "Sockets that are open", number(counts.connections));
  out.single("hl_connections_refused_total", kCounter, "Sockets closed for want of room", number(counts.crowded_out));
  out.single("hl_pages", kGauge, "Viewer pages that are open", number(counts.pages));
  out.single("hl_sessions", kGauge, "HL clients that are connected", number(traffic.sessions));
  out.single("hl_sessions_total", kCounter, "HL clients since the start", number(traffic.sessions_opened));
  out.family("hl_messages_total", kCounter, "WebSocket messages");
  out.sample(number(traffic.messages_in), {{"direction", "in"}});
  out.sample(number(traffic.messages_out), {{"direction", "out"}});
  out.family("hl_bytes_total", kCounter, "Bytes of WebSocket messages");
  out.sample(number(traffic.bytes_in), {{"direction", "in"}});
  out.sample(number(traffic.bytes_out), {{"direction", "out"}});
  out.family("hl_refused_total", kCounter, "Connections, messages and sessions refused, by reason");
  for (std::size_t i = 0; i < kRefusedReasons; ++i) {
    out.sample(number(traffic.refused[i]), {{"reason", kRefusedNames[i]}});
  }
  out.family("hl_uploads_total", kCounter, "Files that pages sent, by what became of them");
  for (std::size_t i = 0; i < kUploadResults; ++i) {
    out.sample(number(traffic.uploads[i]), {{"result", kUploadResultNames[i]}});
  }
  out.single("hl_upload_bytes_total", kCounter, "Bytes of these files", number(traffic.upload_bytes));
}

}  // namespace hl
