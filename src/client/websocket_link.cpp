#include "client/websocket_link.h"

#include <atomic>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/use_future.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/duration.h"
#include "base/error.h"
#include "base/guarded_thread.h"
#include "client/connect_stream.h"
#include "client/reply_inbox.h"
#include "wire/websocket.h"

namespace hl {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

namespace {

constexpr std::size_t kPiece_bytes = std::size_t{64} * 1024;  // frames of a large message; pings pass between them

class WebsocketLink : public Link {
 public:
  WebsocketLink(const ServerAddress& address, const WebsocketLinkSettings& settings)
      : address_(address), settings_(settings), bell_(context_), linger_(context_) {
    if (address_.tls) tls_ = makeClientTls(settings.ca_file);
    auto connected = asio::co_spawn(context_, connect(), asio::use_future);
    thread_ = startThread("hl client", [this] { context_.run(); });
    try {
      connected.get();
    } catch (...) {
      work_.reset();
      context_.stop();
      thread_.join();
      throw;
    }
    asio::co_spawn(context_, talk(), [this](const std::exception_ptr& error) {
      if (error) fail(error);
    });
  }

  ~WebsocketLink() override {
    asio::post(context_, [this] {
      closing_ = true;
      bell_.cancel();
      giveUpLater();
    });
    work_.reset();
    thread_.join();
  }

  void send(proto::ClientMessage message) override {
    if (!inbox_.ended().empty()) return;
    std::string bytes = message.SerializeAsString();
    const std::scoped_lock lock(mutex_);
    if (queued_bytes_ + bytes.size() > settings_.queue_bytes) {
      asio::post(context_, [this] { finish(address_.text() + " takes in messages too slowly; too many bytes wait"); });
      return;
    }
    queued_bytes_ += bytes.size();
    queue_.push_back(std::move(bytes));
    if (queue_.size() == 1) asio::post(context_, [this] { bell_.cancel(); });
  }

  std::size_t queuedBytes() const override { return queued_bytes_; }
  bool take(proto::ServerReply& reply) override { return inbox_.take(reply); }
  bool wait(std::chrono::nanoseconds longest) override { return inbox_.wait(longest); }
  std::string ended() const override { return inbox_.ended(); }

 private:
  asio::awaitable<void> connect() {
    stream_ = co_await connectStream(address_, tls_.get(), durationOf(settings_.connect_s));
    socket_.emplace(*stream_);
    websocket::stream_base::timeout patience{};
    patience.handshake_timeout = durationOf(settings_.connect_s);
    patience.idle_timeout = durationOf(settings_.silence_s);
    patience.keep_alive_pings = true;
    socket_->setTimeout(patience);
    socket_->setReadLimit(settings_.reply_bytes);
    socket_->setPieceSize(kPiece_bytes);
    socket_->setText(false);
    websocket::response_type response;
    auto [error] = co_await socket_->shakeHands(response, address_.text(), "/hl");
    if (error) throw Error(handshakeFailure(error, response));
  }

  std::string handshakeFailure(const boost::system::error_code& error, const websocket::response_type& response) const {
    const std::string who = address_.text();
    if (error == websocket::error::upgrade_declined) {
      return who + " is no HL server, or takes no clients: it answers " + std::to_string(response.result_int());
    }
    if (!address_.tls) return who + " does not answer as an HL server (" + error.message() + "); does it want hls:// ?";
    return who + " does not answer as an HL server (" + error.message() + ")";
  }

  // The link has ended: nothing more is sent or read. In the link's thread, as all below.
  void finish(const std::string& why) {
    inbox_.end(why);
    finished_ = true;
    queued_bytes_ = 0;  // the queue itself stays: a write may still read its first message
    stream_->close();
    bell_.cancel();
    linger_.cancel();
  }

  // Of what was thrown on the way, as where a reply needs more memory than there is.
  void fail(const std::exception_ptr& error) {
    try {
      std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      finish("out of memory");  // short enough to need none
    } catch (const std::exception& why) {
      finish("the connection to " + address_.text() + " is lost: " + why.what());
    }
    socket_.reset();
  }

  std::string reasonOf(const boost::system::error_code& error) const {
    const std::string who = address_.text();
    if (error == websocket::error::closed) {
      const std::string reason = socket_->peerReason();
      return who + " ended the session" + (reason.empty() ? "" : ": " + reason);
    }
    if (error == beast::error::timeout) return who + " has fallen silent; the connection is lost";
    return "the connection to " + who + " is lost: " + error.message();
  }

  // The WebSocket goes at the end: its timers would keep the thread.
  asio::awaitable<void> talk() {
    using namespace asio::experimental::awaitable_operators;
    co_await (read() && write());
    socket_.reset();
  }

  asio::awaitable<void> read() {
    while (!finished_) {
      beast::flat_buffer buffer;
      auto [error, bytes] = co_await socket_->read(buffer);
      if (error) {
        finish(reasonOf(error));
        co_return;
      }
      proto::ServerReply reply;
      const auto data = buffer.cdata();
      if (!reply.ParseFromArray(data.data(), static_cast<int>(data.size()))) {
        finish(address_.text() + " sent what is no HL reply; is it of another version?");
      } else if (inbox_.put(std::move(reply)) > settings_.replies) {
        finish("the program takes no replies; too many of " + address_.text() + " wait");
      }
    }
  }

  asio::awaitable<void> write() {
    while (!finished_) {
      const std::string* next = front();
      if (next != nullptr) {
        auto [error, bytes] = co_await socket_->write(asio::buffer(*next));
        if (error) co_return;  // read() knows why, or will
        popFront();
      } else if (closing_) {
        co_await socket_->close(websocket::close_code::normal);
        finish("the program has ended the session");
      } else {
        bell_.expires_at(asio::steady_timer::time_point::max());
        co_await bell_.async_wait(asio::as_tuple(asio::use_awaitable));
      }
    }
  }

  // Stays where it is while it is written: a deque's elements do not move when others are appended.
  const std::string* front() {
    const std::scoped_lock lock(mutex_);
    return queue_.empty() ? nullptr : &queue_.front();
  }

  void popFront() {
    const std::scoped_lock lock(mutex_);
    if (finished_) return;
    queued_bytes_ -= queue_.front().size();
    queue_.pop_front();
    if (closing_) giveUpLater();
  }

  // A server that takes nothing for so long does not keep the program from ending.
  void giveUpLater() {
    if (finished_) return;
    linger_.expires_after(durationOf(settings_.linger_s));
    linger_.async_wait([this](boost::system::error_code cancelled) {
      if (!cancelled) finish("the program has ended the session");
    });
  }

  ServerAddress address_;
  WebsocketLinkSettings settings_;
  asio::io_context context_{1};
  asio::executor_work_guard<asio::io_context::executor_type> work_ = asio::make_work_guard(context_);
  std::unique_ptr<asio::ssl::context> tls_;
  std::unique_ptr<Stream> stream_;
  std::optional<Websocket> socket_;
  asio::steady_timer bell_, linger_;
  bool closing_ = false;  // the program wants no more
  bool finished_ = false;
  ReplyInbox inbox_;

  std::mutex mutex_;  // guards the queue
  std::deque<std::string> queue_;
  std::atomic<std::size_t> queued_bytes_{0};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Link> connectWebsocket(const ServerAddress& address, const WebsocketLinkSettings& settings) {
  return std::make_unique<WebsocketLink>(address, settings);
}

}  // namespace hl
