#include "http/http_server.h"

#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/file_posix.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/guarded_thread.h"
#include "http/access.h"
#include "http/http_answers.h"
#include "http/listener.h"
#include "http/page_feed.h"
#include "http/traffic.h"
#include "http/upload_receiver.h"
#include "http/websocket_session.h"
#include "http/workers.h"
#include "monitor/event_log.h"
#include "session/client_session.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

namespace {

constexpr std::size_t kMaxRequest_bytes = std::size_t{16} * 1024;
constexpr std::chrono::seconds kRequestTimeout(20);
constexpr std::chrono::minutes kDownloadTimeout(10);  // a recording of 200 MB at 3 Mbit/s
constexpr std::chrono::milliseconds kGrace(1000);     // for HL clients to answer the goodbye when the server stops
constexpr std::chrono::milliseconds kLook(100);       // between two looks whether all that never ends is still there

// TLS and a token are what stands between a stranger on the network and somebody's hand.
ListenerSettings listenerSettings(const HttpServerSettings& settings) {
  ListenerSettings out;
  out.address = parseListenAddress(settings.listen);
  out.port = settings.port;
  out.max_connections = settings.limits.connections;
  out.handshake = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * settings.limits.handshake_s));
  if (!out.address.is_loopback() && (settings.tls.empty() || settings.token.empty())) {
    throw Error("listening on " + settings.listen +
                ", beyond this machine, needs TLS and a token: give a certificate, its key and a token file, or listen "
                "on 127.0.0.1");
  }
  if (settings.tls.empty()) return out;
  out.tls = makeServerTls(settings.tls);
  if (const std::string warning = certificateWarning(*out.tls); !warning.empty())
    logEvent(LogLevel::kWarning, "certificate_is_refused", {{"file", settings.tls.certificate}, {"reason", warning}});
  return out;
}

struct Refusal {
  http::status status;
  RefusedBecause because;
  const char* text;
};

constexpr Refusal kTooLargeRequest{http::status::payload_too_large, RefusedBecause::kTooLarge,
                                   "a request here has at most 16 kB; files go to /upload"};

// For the log: one line.
std::string reasonOf(const HttpResponse& refusal) {
  const std::string& text = refusal.body();
  return text.substr(0, text.find('\n'));
}

// Of what was no request; nothing for a connection that has ended, also within one.
std::optional<Refusal> refusalOf(const beast::error_code& error) {
  if (error == http::error::header_limit)
    return Refusal{http::status::request_header_fields_too_large, RefusedBecause::kTooLarge,
                   "the head of a request has at most 16 kB"};
  if (error == http::error::body_limit) return kTooLargeRequest;
  const bool ended = error == http::error::end_of_stream || error == http::error::partial_message;
  if (ended || error.category() != make_error_code(http::error::bad_version).category()) return std::nullopt;
  return Refusal{http::status::bad_request, RefusedBecause::kMalformed, "this is no HTTP request"};
}

AccessSettings accessSettings(const HttpServerSettings& settings, std::uint16_t port) {
  return {parseListenAddress(settings.listen).is_loopback(), !settings.tls.empty(), port, settings.token};
}

}  // namespace

class HttpServer::Impl {
 public:
  Impl(const HttpServerSettings& settings, FeedCallbacks pages, SessionHost* host, MonitorCallbacks monitor)
      : settings_(settings),
        monitor_(std::move(monitor)),
        host_(host),
        light_workers_("light worker", 1),
        heavy_workers_("worker", settings.limits.workers),
        page_worker_("pages", 1),
        listener_(context_, listenerSettings(settings)),
        access_(accessSettings(settings, listener_.port())),
        recording_(pages.recording),
        pages_(context_, page_worker_, settings.feed_rate_Hz, std::move(pages), monitor_.observe, settings_.limits,
               traffic_),
        answers_(access_, {settings.page_folder, [this] { return fault(); },
                           [this](const ServerCounts& counts) { return metrics(counts); }}),
        uploads_(context_, settings.upload, answers_, traffic_) {}

  std::uint16_t port() const { return listener_.port(); }
  void setToken(const std::string& token) { access_.setToken(token); }

  void start() {
    listener_.start({[this](ConnectionPointer connection) { return serve(std::move(connection)); },
                     [this](const std::string& peer) { logCrowdedOut(peer); },
                     [this](const std::string& peer, const std::string& why) {
                       if (why.empty()) return traffic_.refuse(RefusedBecause::kHandshake);  // a probe, say
                       logRefused(peer, RefusedBecause::kHandshake, "no TLS 1.3 handshake: " + why);
                     }});
    pages_.start();
    thread_ = startThread("network", [this] { run(); });
  }

  // Every coroutine ends because its socket or timer does; so the threads run out of work, and nothing is cut off.
  void stop() {
    if (!thread_.joinable()) return;
    asio::post(context_, [this] {
      stopping_ = true;
      pages_.stop();
      listener_.stop(kGrace);
    });
    thread_.join();
    for (Workers* workers : {&light_workers_, &heavy_workers_, &page_worker_}) workers->join();
    uploads_.join();
  }

 private:
  // A handler that throws has lost its own work only. What never ends, accepting connections and feeding pages, begins
  // again where it was lost so.
  void run() {
    while (!stopping_ || !context_.stopped()) {
      guarded([this] {
        if (context_.stopped()) context_.restart();
        context_.run_for(kLook);
      });
      if (stopping_) continue;
      guarded([this] {
        listener_.keepAccepting();
        pages_.keepFeeding();
      });
    }
  }

  // One HTTP connection; it may become a WebSocket.
  asio::awaitable<void> serve(ConnectionPointer connection) {
    beast::flat_buffer buffer;
    for (bool first = true;; first = false) {
      HeadParser head;
      head.header_limit(kMaxRequest_bytes);
      head.body_limit(boost::none);  // files have a limit of their own
      connection->stream.tcp().expires_after(kRequestTimeout);
      auto [no_head, head_bytes] = co_await http::async_read_header(connection->stream, buffer, head, kAwait);
      if (no_head == beast::error::timeout && first && buffer.size() == 0)
        co_return traffic_.refuse(RefusedBecause::kSilent);
      if (no_head == beast::error::timeout && first)
        co_return logRefused(connection->peer, RefusedBecause::kSilent, "it has not asked to the end in time");
      if (no_head) co_return co_await refuse(connection, refusalOf(no_head));
      if (isUpload(viewOf(head.get().target()))) {
        const bool goes_on = co_await uploads_.serve(connection, buffer, head);
        if (!goes_on) co_return;
        continue;
      }
      if (head.content_length().value_or(0) > kMaxRequest_bytes)
        co_return co_await refuse(connection, kTooLargeRequest);
      http::request_parser<http::string_body> parser(std::move(head));
      parser.body_limit(kMaxRequest_bytes);
      auto [error, bytes] = co_await http::async_read(connection->stream, buffer, parser, kAwait);
      if (error) co_return co_await refuse(connection, refusalOf(error));
      HttpRequest request = parser.release();
      if (websocket::is_upgrade(request) && answers_.mayConnect(request)) {
        const bool upgraded = co_await upgrade(connection, request);
        if (upgraded) co_return;
      }
      if (answers_.asksForRecording(request)) {
        const bool goes_on = co_await sendRecording(connection, request);
        if (!goes_on) co_return;
        continue;
      }
      auto response = co_await answer(connection->peer, request);
      auto [failed, sent] = co_await http::async_write(connection->stream, response, kAwait);
      if (failed || !response.keep_alive()) co_return;
    }
  }

  // What cannot be a request is answered once, and the connection ends: where the next one begins is not known.
  asio::awaitable<void> refuse(ConnectionPointer connection, std::optional<Refusal> refusal) {
    if (!refusal) co_return;
    logRefused(connection->peer, refusal->because, refusal->text);
    HttpRequest none;
    none.version(11);
    none.keep_alive(false);
    const HttpResponse response = HttpAnswers::refuse(none, refusal->status, refusal->text);
    co_await http::async_write(connection->stream, response, kAwait);
  }

  // Serves the WebSocket that is asked for, if it is one of ours and there is room; false: it has not been accepted.
  asio::awaitable<bool> upgrade(ConnectionPointer connection, HttpRequest& request) {
    const bool trusted = answers_.isTrusted(request);
    const bool viewer = request.target() == "/viewer" && trusted && !pages_.full();
    const bool client = request.target() == "/hl" && host_ != nullptr;
    if (!viewer && !client) co_return false;
    connection->stream.tcp().expires_never();  // WebSockets have their own timeouts
    if (viewer) {
      co_await pages_.serve(connection, std::move(request));
    } else {
      const WebSocketContext world{context_, light_workers_,   heavy_workers_, *host_,
                                   access_,  settings_.limits, traffic_};
      co_await std::make_shared<WebSocketSession>(world, connection, trusted)->run(std::move(request));
    }
    co_return true;
  }

  // The file goes out piece by piece; false: the connection has ended.
  asio::awaitable<bool> sendRecording(ConnectionPointer connection, const HttpRequest& request) {
    const FilePointer file = recording_ ? recording_(HttpAnswers::ownerOf(request)) : nullptr;
    if (!file) {
      auto refusal = HttpAnswers::refuse(request, http::status::not_found, "this recording is no longer there");
      auto [failed, sent] = co_await http::async_write(connection->stream, refusal, kAwait);
      co_return !failed && refusal.keep_alive();
    }
    HttpFileResponse response = HttpAnswers::sendRecording(request);
    beast::file_posix opened;
    opened.native_handle(dup(file->descriptor()));
    beast::error_code error;
    response.body().reset(std::move(opened), error);
    if (error) co_return false;
    response.prepare_payload();
    connection->stream.tcp().expires_after(kDownloadTimeout);
    auto [failed, sent] = co_await http::async_write(connection->stream, response, kAwait);
    co_return !failed && response.keep_alive();
  }

  asio::awaitable<HttpResponse> answer(const std::string& peer, const HttpRequest& request) {
    if (websocket::is_upgrade(request) && request.target() == "/viewer" && pages_.full()) {
      traffic_.refuse(RefusedBecause::kFull);
      co_return HttpAnswers::refuse(request, http::status::service_unavailable, "too many pages; close one");
    }
    const bool of_sockets = request.target() == "/viewer" || (request.target() == "/hl" && host_ != nullptr);
    if (of_sockets && !websocket::is_upgrade(request) && answers_.mayConnect(request))
      co_return HttpAnswers::refuse(request, http::status::upgrade_required, "this address is for WebSockets");
    const ServerCounts counts{traffic_, listener_.connections(), pages_.pages(), listener_.refused()};
    HttpResponse response = co_await doOn(page_worker_, [&] { return answers_.answer(request, counts); });
    const bool denied = response.result() == http::status::forbidden || response.result() == http::status::unauthorized;
    if (denied) logDenied(peer, request, response);
    co_return response;
  }

  void logRefused(const std::string& peer, RefusedBecause because, const std::string& text) {
    traffic_.refuse(because);
    logEvent(LogLevel::kWarning, "refused", {{"peer", peer}, {"reason", text}});
  }

  // Counted by the listener.
  void logCrowdedOut(const std::string& peer) {
    logEvent(LogLevel::kWarning, "refused",
             {{"peer", peer},
              {"reason",
               "there are " + std::to_string(listener_.connections()) + " connections already, as many as may be"}});
  }

  void logDenied(const std::string& peer, const HttpRequest& request, const HttpResponse& response) {
    traffic_.refuse(RefusedBecause::kAccess);
    const std::string host(request[http::field::host]);
    logEvent(LogLevel::kWarning, "refused", {{"peer", peer}, {"host", host}, {"reason", reasonOf(response)}});
  }

  std::string fault() const { return monitor_.fault ? monitor_.fault() : std::string(); }

  std::string metrics(const ServerCounts& counts) const {
    MetricsText out;
    writeTraffic(out, counts);
    if (monitor_.metrics) monitor_.metrics(out);
    return out.text();
  }

  HttpServerSettings settings_;
  MonitorCallbacks monitor_;
  SessionHost* host_;
  asio::io_context context_{1};
  Workers light_workers_, heavy_workers_;  // for HL clients
  Workers page_worker_;                    // for what pages are sent and what is asked over HTTP
  Traffic traffic_;
  Listener listener_;
  Access access_;
  std::function<FilePointer(std::uint32_t owner)> recording_;
  PageFeed pages_;
  HttpAnswers answers_;
  UploadReceiver uploads_;
  bool stopping_ = false;  // in the server's thread
  std::thread thread_;
};

HttpServer::HttpServer(const HttpServerSettings& settings, FeedCallbacks pages, SessionHost* host,
                       MonitorCallbacks monitor)
    : impl_(std::make_unique<Impl>(settings, std::move(pages), host, std::move(monitor))) {}
HttpServer::~HttpServer() { stop(); }
std::uint16_t HttpServer::port() const { return impl_->port(); }
void HttpServer::start() { impl_->start(); }
void HttpServer::stop() { impl_->stop(); }
void HttpServer::setToken(const std::string& token) { impl_->setToken(token); }

}  // namespace hl
