#include "http/listener.h"

#include <fcntl.h>

#include <boost/asio/co_spawn.hpp>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/flag.h"
#include "base/guarded_thread.h"
#include "http/workers.h"

namespace hl {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::chrono::milliseconds kPause(50);  // after a failed accept: out of descriptors, say

std::string nameOf(const tcp::endpoint& endpoint) {
  const std::string address = endpoint.address().to_string();
  const std::string host = endpoint.address().is_v6() ? "[" + address + "]" : address;
  return host + ":" + std::to_string(endpoint.port());
}

// A program that this one starts must not keep the port, nor somebody's connection.
void keepFromChildren(int socket) { fcntl(socket, F_SETFD, FD_CLOEXEC); }

}  // namespace

// The place of one connection among all, until what serves it has ended, however that came.
class Listener::Slot {
 public:
  Slot(Listener& listener, ConnectionPointer connection) : listener_(listener), connection_(std::move(connection)) {
    listener_.connections_.insert(connection_);
  }
  ~Slot() {
    connection_->farewell = nullptr;
    connection_->stream.close();
    listener_.connections_.erase(connection_);
    if (listener_.stopping_ && listener_.connections_.empty()) listener_.pause_.cancel();
  }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;
  const ConnectionPointer& connection() const { return connection_; }

 private:
  Listener& listener_;
  ConnectionPointer connection_;
};

asio::ip::address parseListenAddress(const std::string& text) {
  if (text == "localhost") return asio::ip::address_v4::loopback();
  boost::system::error_code error;
  const auto address = asio::ip::make_address(text, error);
  if (error)
    throw Error("'" + text + "' is no address to listen on; give 127.0.0.1, ::1, 0.0.0.0, :: or one of this machine's");
  return address;
}

Listener::Listener(asio::io_context& context, const ListenerSettings& settings)
    : context_(context), settings_(settings), acceptor_(context), pause_(context) {
  listen(settings);
  port_ = acceptor_.local_endpoint().port();
}

void Listener::listen(const ListenerSettings& settings) {
  boost::system::error_code error;
  const tcp::endpoint endpoint(settings.address, settings.port);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) keepFromChildren(acceptor_.native_handle());
  if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw Error("cannot listen on " + nameOf(endpoint) + " (" + error.message() +
                "); choose another port with --port N, or --port 0 for any free one");
  }
}

void Listener::start(ListenerCallbacks callbacks) {
  callbacks_ = std::move(callbacks);
  keepAccepting();
}

void Listener::keepAccepting() {
  if (!accepting_ && !stopping_) asio::co_spawn(context_, accept(), reportEnd);
}

asio::awaitable<void> Listener::accept() {
  const Flag accepting(accepting_);
  while (!stopping_) {
    auto [error, socket] = co_await acceptor_.async_accept(kAwait);
    if (stopping_) co_return;
    if (error) {
      pause_.expires_after(kPause);
      co_await pause_.async_wait(kAwait);
      continue;
    }
    guarded([this, &peer = socket] { take(std::move(peer)); });
  }
}

void Listener::take(tcp::socket socket) {
  boost::system::error_code gone;
  const tcp::endpoint peer = socket.remote_endpoint(gone);
  if (gone || connections_.size() >= settings_.max_connections) {
    ++refused_;
    if (!gone) sayCrowdedOut(peer);
    return;  // and the socket closes
  }
  keepFromChildren(socket.native_handle());
  // Messages are small and their time matters more than their number of packets.
  socket.set_option(tcp::no_delay(true), gone);
  auto slot = std::make_unique<Slot>(
      *this, std::make_shared<Connection>(Stream::Tcp(std::move(socket)), settings_.tls.get(), nameOf(peer)));
  asio::co_spawn(context_, admit(std::move(slot)), reportEnd);
}

void Listener::sayCrowdedOut(const tcp::endpoint& peer) {
  constexpr std::chrono::seconds kEvery(10);
  const auto now = std::chrono::steady_clock::now();
  if (now - crowded_said_ < kEvery) return;
  crowded_said_ = now;
  callbacks_.crowded_out(nameOf(peer));
}

asio::awaitable<void> Listener::admit(std::unique_ptr<Slot> slot) {
  const bool welcome = co_await shakeHands(*slot->connection());
  if (welcome) co_await callbacks_.serve(slot->connection());
}

asio::awaitable<bool> Listener::shakeHands(Connection& connection) {
  Stream::Tls* tls = connection.stream.tls();
  if (tls == nullptr) co_return true;
  connection.stream.tcp().expires_after(settings_.handshake);
  auto [error] = co_await tls->async_handshake(asio::ssl::stream_base::server, kAwait);
  const bool gone = error == asio::error::eof || error == asio::error::connection_reset ||
                    error == asio::ssl::error::stream_truncated;
  if (error && !stopping_) callbacks_.no_handshake(connection.peer, gone ? "" : error.message());
  co_return !error;
}

void Listener::stop(std::chrono::milliseconds grace) {
  stopping_ = true;
  acceptor_.close();
  pause_.cancel();
  for (const ConnectionPointer& connection : connections_) {
    if (connection->farewell) {
      connection->farewell();
    } else {
      connection->stream.close();
    }
  }
  if (!connections_.empty()) asio::co_spawn(context_, closeLater(grace), reportEnd);
}

asio::awaitable<void> Listener::closeLater(std::chrono::milliseconds grace) {
  pause_.expires_after(grace);
  co_await pause_.async_wait(kAwait);
  for (const ConnectionPointer& connection : connections_) connection->stream.close();
}

}  // namespace hl
