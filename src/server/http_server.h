// HttpServer: the page and its WebSocket, on loopback only, in one thread of its own.
// It serves the files of one folder, refuses foreign Hosts and Origins, bounds every message, and never queues:
// a page that reads slowly misses states, the newest one wins.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace hl {

struct HttpServerSettings {
  std::uint16_t port = 1997;  ///< 0: any free one
  std::string page_folder;    ///< the built page; a notice is served when it is missing
  double feed_rate_Hz = 60;
};

/// Gives one page the next message of the scene that it lacks; empty when it has everything.
using SceneSource = std::function<std::shared_ptr<const std::string>()>;

/// Called in the server's thread. The strings are complete WebSocket binary messages.
struct FeedCallbacks {
  std::function<std::string()> hello;
  std::function<SceneSource()> scene;  ///< once for each page; what it gives is asked before each state
  std::function<std::string()> state;
  std::function<void(const std::string&)> receive;  ///< one message of at most kMaxInbound_bytes from a page
};

class HttpServer {
 public:
  static constexpr std::size_t kMaxInbound_bytes = 4096;
  static constexpr std::size_t kMaxPages = 16;       ///< WebSockets at once; more are refused
  static constexpr double kMaxInboundRate_Hz = 500;  ///< per page; a page that sends faster is closed

  /// Listens at once; throws hl::Error when the port is taken.
  HttpServer(const HttpServerSettings& settings, FeedCallbacks callbacks);
  ~HttpServer();
  std::uint16_t port() const;
  void start();
  void stop();  ///< closes all connections and joins the thread; safe to call twice

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hl
