#include "device/haply/haply_link.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/guarded_thread.h"
#include "base/printable.h"
#include "base/realtime.h"
#include "base/text.h"
#include "base/url.h"
#include "device/device_claim.h"
#include "device/exchange.h"
#include "device/haply/haply_messages.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

namespace {

constexpr auto kAwait = asio::as_tuple(asio::use_awaitable);
constexpr auto kAnswerIn = std::chrono::milliseconds(500);
constexpr auto kConnectEvery = std::chrono::milliseconds(100);
constexpr auto kMessageEvery = std::chrono::microseconds(250);  // the device's 4 kHz, and no more
constexpr int kLinkPriority = 75;                               // SCHED_FIFO; below the servo, above the proxy
constexpr std::uint16_t kOldHttpPort = 10000;                   // of services before 3.5
constexpr std::size_t kMaxMessage = std::size_t{1} << 20;

using Socket = websocket::stream<beast::tcp_stream>;

// As the service shows them: 049D.
bool isHaplyId(const std::string& text) {
  const auto fits = [](char c) { return isLetterOrDigit(c) || c == '-' || c == '_'; };
  return !text.empty() && std::all_of(text.begin(), text.end(), fits);
}

std::string listOfIds(const std::vector<std::string>& ids) {
  std::string list;
  for (const std::string& id : ids) list += (list.empty() ? "" : ", ") + id;
  return list;
}

}  // namespace

HaplyAddress HaplyAddress::parse(const std::string& text) {
  HaplyAddress address;
  if (text.empty()) return address;
  checkPrintable(text, "an address");
  if (isHaplyId(text)) {
    address.device_id = text;
    return address;
  }
  const auto refuse = [&](const std::string& why) {
    throw Error(
        "'" + text + "' is no Haply device (" + why +
        "): it is ws://HOST or ws://HOST:PORT, with /ID behind it where the service has several, or the ID alone");
  };
  Url url;
  try {
    url = parseUrl(text);
  } catch (const Error& error) {
    refuse(error.what());
  }
  if (url.scheme != "ws" || !url.host) refuse("it does not begin with ws:// and a host");
  const bool named = !url.path.empty() && url.path != "/";
  if (named) address.device_id = url.path.substr(1);
  const bool good = !named || (url.path.front() == '/' && isHaplyId(address.device_id));
  if (!good || !url.options.empty()) refuse("nothing but the id of a device follows the host and its port");
  address.host = *url.host;
  if (url.port) address.port = *url.port;
  return address;
}

std::string HaplyAddress::text() const { return "ws://" + hostAndPort(host, port); }

class HaplyLink::Conversation {
 public:
  explicit Conversation(HaplyAddress address)
      : address_(std::move(address)), thread_(startThread("haply", [this] { run(); })) {
    const std::string why = begun_.get_future().get();
    if (why.empty()) return;
    end();
    throw Error(why);
  }
  ~Conversation() { end(); }

  const std::string& deviceId() const { return device_id_; }
  bool hasGrip() const { return has_grip_; }
  Exchange exchanged;

 private:
  void end() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
  }

  void run() {
    requestRealtime(kLinkPriority);
    if (!conversing_) asio::co_spawn(context_, converseAlways(), asio::detached);
    context_.run();
  }

  asio::awaitable<void> converseAlways() {
    const Flag conversing(conversing_);
    while (!ending_) {
      std::string why;
      try {
        why = co_await converse();
      } catch (const std::exception& error) {
        why = error.what();
      }
      reportBegun(why);
      exchanged.reportLost();
      asio::steady_timer timer(context_, kConnectEvery);
      if (!ending_) co_await timer.async_wait(kAwait);
    }
  }

  // Once: how the first attempt went.
  void reportBegun(const std::string& why) {
    if (!std::exchange(reported_, true)) begun_.set_value(why);
  }

  // Until it ends; returns why.
  asio::awaitable<std::string> converse() {
    const HaplyDialect dialect = haplyDialectOf(co_await version());
    Socket socket(context_);
    const std::string failure = co_await connect(socket);
    if (!failure.empty()) co_return failure;
    HaplyState state;
    state.device_id = address_.device_id;
    const std::optional<std::string> inventory = co_await receive(socket);
    if (!inventory || !readHaplyMessage(*inventory, state))
      co_return address_.text() + " is no Haply Inverse Service: it does not say what it has";
    const std::string missing = whatIsMissing(haplyDevicesOf(*inventory));
    if (!missing.empty()) co_return missing;
    const std::string key = "haply " + address_.text() + "/" + state.device_id;
    if (claim_.key() != key) claim_ = DeviceClaim(key);
    if (!reported_) {
      device_id_ = state.device_id;
      has_grip_ = state.has_grip;
    }
    co_await exchange(socket, state, dialect);
    co_return "the Haply service at " + address_.text() + " does not answer any more";
  }

  // The answer to GET /version, on the one port of new services or on the other of old ones; empty when there is none.
  asio::awaitable<std::string> version() {
    std::string text = co_await get(address_.port);
    if (text.empty()) text = co_await get(kOldHttpPort);
    co_return text;
  }

  asio::awaitable<std::string> get(std::uint16_t port) {
    beast::tcp_stream stream(context_);
    const bool connected = co_await reach(stream, port);
    if (!connected) co_return "";
    http::request<http::empty_body> request{http::verb::get, "/version", 11};
    request.set(http::field::host, address_.host + ":" + std::to_string(port));
    auto [unsent, sent] = co_await http::async_write(stream, request, kAwait);
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    auto [unread, bytes] = co_await http::async_read(stream, buffer, response, kAwait);
    co_return unsent || unread || response.result() != http::status::ok ? "" : response.body();
  }

  asio::awaitable<bool> reach(beast::tcp_stream& stream, std::uint16_t port) {
    tcp::resolver resolver(context_);
    auto [unknown, endpoints] = co_await resolver.async_resolve(address_.host, std::to_string(port), kAwait);
    if (unknown) co_return false;
    stream.expires_after(kAnswerIn);
    auto [error, endpoint] = co_await stream.async_connect(endpoints, kAwait);
    if (error) co_return false;
    stream.socket().set_option(tcp::no_delay(true), error);
    co_return true;
  }

  // Why it cannot; empty when it has.
  asio::awaitable<std::string> connect(Socket& socket) {
    const std::string none = "no Haply Inverse Service answers at " + address_.text() +
                             ": install it (haply-inverse-service, from haply.co) and start it";
    const bool reached = co_await reach(socket.next_layer(), address_.port);
    if (!reached) co_return none;
    socket.read_message_max(kMaxMessage);
    auto [error] = co_await socket.async_handshake(address_.host + ":" + std::to_string(address_.port), "/", kAwait);
    co_return error ? none : "";
  }

  // Empty: the device that is wanted is there.
  std::string whatIsMissing(const std::vector<std::string>& devices) const {
    const std::string service = "the Haply service at " + address_.text() + " has no Inverse3";
    const std::string& wanted = address_.device_id;
    if (devices.empty()) return service + ": check its power and its cable";
    if (wanted.empty() || std::find(devices.begin(), devices.end(), wanted) != devices.end()) return "";
    return service + " '" + wanted + "': it has " + listOfIds(devices);
  }

  // Nothing when none comes in time.
  asio::awaitable<std::optional<std::string>> receive(Socket& socket) {
    socket.next_layer().expires_after(kAnswerIn);
    beast::flat_buffer buffer;
    auto [error, bytes] = co_await socket.async_read(buffer, kAwait);
    if (error) co_return std::nullopt;
    co_return beast::buffers_to_string(buffer.cdata());
  }

  // One state for each message, until one of the two has had enough; the last force is zero.
  asio::awaitable<void> exchange(Socket& socket, HaplyState& state, HaplyDialect dialect) {
    asio::steady_timer timer(context_);
    bool first = true;
    for (bool last = false; !last; first = false) {
      last = ending_;
      const Vec3 force = last ? Vec3(Vec3::Zero()) : exchanged.wantedForce();
      const std::string message = haplyForceMessage(state.device_id, dialect, force, first);
      timer.expires_after(kMessageEvery);
      socket.next_layer().expires_after(kAnswerIn);
      const std::int64_t asked_ns = monotonicNow_ns();
      auto [unsent, sent] = co_await socket.async_write(asio::buffer(message), kAwait);
      if (unsent) co_return;
      const std::optional<std::string> answer = co_await receive(socket);
      if (!answer || !readHaplyMessage(*answer, state) || !state.located) co_return;
      exchanged.report(asked_ns, state.position, state.buttons,
                       state.calibrated ? DeviceStatus::kOk : DeviceStatus::kNotReady, state.stylus);
      reportBegun("");
      if (!last) co_await timer.async_wait(kAwait);
    }
    co_await socket.async_close(websocket::close_code::normal, kAwait);
  }

  const HaplyAddress address_;
  asio::io_context context_{1};
  std::atomic<bool> ending_{false};
  std::promise<std::string> begun_;
  bool reported_ = false;
  bool conversing_ = false;
  std::string device_id_;  // this and the next are written before begun_ is set
  bool has_grip_ = false;
  DeviceClaim claim_;   // from the first conversation to the end
  std::thread thread_;  // last: it uses all of the above
};

HaplyLink::HaplyLink(const HaplyAddress& address) : conversation_(std::make_unique<Conversation>(address)) {}
HaplyLink::~HaplyLink() = default;

const std::string& HaplyLink::deviceId() const { return conversation_->deviceId(); }

bool HaplyLink::hasGrip() const { return conversation_->hasGrip(); }

DeviceSample HaplyLink::newest(std::int64_t now_ns) { return conversation_->exchanged.newest(now_ns); }

void HaplyLink::pull(const Vec3& force_D) { conversation_->exchanged.pull(force_D); }

}  // namespace hl
