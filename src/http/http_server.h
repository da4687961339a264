// HttpServer: the page and its WebSocket /viewer, HL clients at /hl, /healthz, /metrics and /upload, on one port.
// One thread moves bytes and talks with the pages; a few workers decode what HL clients send. Loopback only unless set
// otherwise; beyond it insists on TLS and a token. Every message is bounded, and nothing is queued for a slow reader.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "http/tls.h"
#include "http/upload_settings.h"
#include "monitor/monitor_callbacks.h"
#include "page/feed_callbacks.h"
#include "session/limits.h"

namespace hl {

class SessionHost;

struct HttpServerSettings {
  std::uint16_t port = 1997;  ///< 0: any free one
  std::string page_folder;    ///< the built page; a notice is served when it is missing
  double feed_rate_Hz = 60;
  std::string listen = "127.0.0.1";  ///< an address of this machine; beyond loopback `tls` and `token` are needed
  TlsFiles tls{};                    ///< empty: none
  std::string token{};               ///< empty: none is asked for; else as checkToken() wants it
  Limits limits{};
  UploadSettings upload{};
};

/// Constructed, started, stopped and destroyed by one thread.
class HttpServer {
 public:
  /// Listens at once; throws hl::Error when the port is taken, a file of `tls` is no good, or the address is beyond
  /// loopback and TLS or the token are missing. `host` outlives the server; null: there is no /hl.
  HttpServer(const HttpServerSettings& settings, FeedCallbacks pages, SessionHost* host = nullptr,
             MonitorCallbacks monitor = {});
  ~HttpServer();
  std::uint16_t port() const;
  void start();
  /// Says goodbye to HL clients, closes all connections and joins the threads; safe to call twice.
  void stop();
  /// Any thread. Throws hl::Error for a token that is no good; the one before then stays. Open sessions stay.
  void setToken(const std::string& token);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hl
