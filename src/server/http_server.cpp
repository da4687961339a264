#include "server/http_server.h"

#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <set>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "server/static_files.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

namespace {

constexpr auto kUse = asio::as_tuple(asio::use_awaitable);  // errors as values
constexpr std::size_t kMaxRequest_bytes = std::size_t{16} * 1024;
constexpr auto kRequestTimeout = std::chrono::seconds(20);

http::response<http::string_body> respond(const http::request<http::string_body>& request, http::status status,
                                          const std::string& mime, std::string body) {
  http::response<http::string_body> response(status, request.version());
  response.set(http::field::server, "hl");
  response.set(http::field::content_type, mime);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set(
      "Content-Security-Policy",
      "default-src 'self'; connect-src 'self' ws:; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
      "worker-src 'self' blob:; frame-ancestors 'none'");
  response.keep_alive(request.keep_alive());
  response.body() = std::move(body);
  response.prepare_payload();
  return response;
}

std::string_view text(boost::beast::string_view s) { return {s.data(), s.size()}; }

}  // namespace

class HttpServer::Impl {
 public:
  Impl(const HttpServerSettings& settings, FeedCallbacks callbacks)
      : settings_(settings), callbacks_(std::move(callbacks)), acceptor_(context_) {
    boost::system::error_code error;
    const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), settings.port);
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(asio::socket_base::reuse_address(true));
    acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw Error("cannot listen on 127.0.0.1:" + std::to_string(settings.port) + " (" + error.message() +
                  "); choose another port with --port N, or --port 0 for any free one");
    }
    port_ = acceptor_.local_endpoint().port();
  }

  std::uint16_t port() const { return port_; }

  void start() {
    asio::co_spawn(context_, accept(), asio::detached);
    asio::co_spawn(context_, feed(), asio::detached);
    thread_ = std::thread([this] { context_.run(); });
  }

  void stop() {
    context_.stop();
    if (thread_.joinable()) thread_.join();
  }

 private:
  struct Page {
    explicit Page(tcp::socket socket) : stream(std::move(socket)) {}
    websocket::stream<tcp::socket> stream;
    SceneSource scene;
    bool busy = true;  // a write is under way
  };
  using PagePointer = std::shared_ptr<Page>;

  asio::awaitable<void> accept() {
    while (true) {
      auto [error, socket] = co_await acceptor_.async_accept(kUse);
      if (!error) {
        asio::co_spawn(context_, serve(std::move(socket)), asio::detached);
      } else {  // out of descriptors, say: wait a little instead of spinning
        asio::steady_timer pause(context_, std::chrono::milliseconds(50));
        co_await pause.async_wait(kUse);
      }
    }
  }

  // One HTTP connection; it may become a WebSocket.
  asio::awaitable<void> serve(tcp::socket socket) {
    beast::tcp_stream stream(std::move(socket));
    beast::flat_buffer buffer;
    while (true) {
      http::request_parser<http::string_body> parser;
      parser.header_limit(kMaxRequest_bytes);
      parser.body_limit(kMaxRequest_bytes);
      stream.expires_after(kRequestTimeout);
      auto [error, bytes] = co_await http::async_read(stream, buffer, parser, kUse);
      if (error) co_return;
      const http::request<http::string_body> request = parser.release();
      if (websocket::is_upgrade(request) && isAllowed(request) && request.target() == "/viewer" &&
          pages_.size() < kMaxPages) {
        stream.expires_never();
        co_await talk(std::make_shared<Page>(stream.release_socket()), request);
        co_return;
      }
      auto response = answer(request);
      auto [failed, sent] = co_await http::async_write(stream, response, kUse);
      if (failed || !request.keep_alive()) co_return;
    }
  }

  bool isAllowed(const http::request<http::string_body>& request) const {
    return isLoopbackHost(text(request[http::field::host]), port_) &&
           isOwnOrigin(text(request[http::field::origin]), port_);
  }

  http::response<http::string_body> answer(const http::request<http::string_body>& request) const {
    if (!isAllowed(request)) {
      return respond(request, http::status::forbidden, "text/plain", "only this machine's own page may connect\n");
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return respond(request, http::status::method_not_allowed, "text/plain", "GET only\n");
    }
    const std::string_view target = text(request.target());
    if (auto file = readStaticFile(settings_.page_folder, target)) {
      if (request.method() == http::verb::head) file->content.clear();
      return respond(request, http::status::ok, file->mime, std::move(file->content));
    }
    if (target == "/") return respond(request, http::status::ok, "text/html; charset=utf-8", missingPageNotice());
    return respond(request, http::status::not_found, "text/plain", "no such file\n");
  }

  asio::awaitable<void> talk(PagePointer page, http::request<http::string_body> request) {
    page->stream.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    page->stream.read_message_max(kMaxInbound_bytes);
    page->stream.binary(true);
    auto [refused] = co_await page->stream.async_accept(request, kUse);
    if (refused) co_return;
    pages_.insert(page);
    asio::co_spawn(context_, greet(page), asio::detached);
    co_await listen(page);
    pages_.erase(page);
  }

  asio::awaitable<void> greet(PagePointer page) {
    const std::string hello = callbacks_.hello();
    page->scene = callbacks_.scene();
    auto [error, bytes] = co_await page->stream.async_write(asio::buffer(hello), kUse);
    if (!error) page->busy = false;
  }

  // Reads until the page goes away, sends too fast or breaks the protocol.
  asio::awaitable<void> listen(PagePointer page) {
    std::int64_t second_ns = monotonicNow_ns();
    int received = 0;
    while (true) {
      beast::flat_buffer buffer;
      auto [error, bytes] = co_await page->stream.async_read(buffer, kUse);
      if (error) co_return;
      if (monotonicNow_ns() - second_ns > 1'000'000'000) {
        second_ns = monotonicNow_ns();
        received = 0;
      }
      if (++received > kMaxInboundRate_Hz) {
        co_await page->stream.async_close({websocket::close_code::policy_error, "too many messages"}, kUse);
        co_return;
      }
      callbacks_.receive(beast::buffers_to_string(buffer.data()));
    }
  }

  // The same state to every page that is ready for one.
  asio::awaitable<void> feed() {
    asio::steady_timer timer(context_);
    const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / settings_.feed_rate_Hz));
    while (true) {
      timer.expires_after(period);
      co_await timer.async_wait(kUse);
      const auto state = std::make_shared<const std::string>(callbacks_.state());
      for (const PagePointer& page : pages_) {
        if (!page->busy) asio::co_spawn(context_, send(page, state), asio::detached);
      }
    }
  }

  // What the page lacks of the scene goes first; while it is on its way the page gets no states.
  asio::awaitable<void> send(PagePointer page, std::shared_ptr<const std::string> state) {
    page->busy = true;
    while (const auto message = page->scene()) {
      auto [failed, sent] = co_await page->stream.async_write(asio::buffer(*message), kUse);
      if (failed) co_return;
    }
    auto [error, bytes] = co_await page->stream.async_write(asio::buffer(*state), kUse);
    if (!error) page->busy = false;
  }

  HttpServerSettings settings_;
  FeedCallbacks callbacks_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  std::uint16_t port_ = 0;
  std::set<PagePointer> pages_;
  std::thread thread_;
};

HttpServer::HttpServer(const HttpServerSettings& settings, FeedCallbacks callbacks)
    : impl_(std::make_unique<Impl>(settings, std::move(callbacks))) {}
HttpServer::~HttpServer() { stop(); }
std::uint16_t HttpServer::port() const { return impl_->port(); }
void HttpServer::start() { impl_->start(); }
void HttpServer::stop() { impl_->stop(); }

}  // namespace hl
