// Listener: accepts connections on one address, does the TLS handshake, and keeps count, so that there are never too
// many and that the server can end them all.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "http/connection.h"

namespace hl {

struct ListenerSettings {
  boost::asio::ip::address address;
  std::uint16_t port = 0;                          ///< 0: any free one
  std::shared_ptr<boost::asio::ssl::context> tls;  ///< null: plain TCP
  std::size_t max_connections = 0;                 ///< more are closed at once
  std::chrono::milliseconds handshake{0};
};

struct ListenerCallbacks {
  /// Serves one accepted connection; the connection is closed when it returns.
  std::function<boost::asio::awaitable<void>(ConnectionPointer)> serve;
  /// A connection beyond max_connections has been closed. Called once in ten seconds: who is crowded out tries again.
  std::function<void(const std::string& peer)> crowded_out;
  /// A connection has been closed without a TLS handshake, for this reason; empty: the peer has closed it.
  std::function<void(const std::string& peer, const std::string& why)> no_handshake;
};

/// An address such as 127.0.0.1, ::1, 0.0.0.0 or localhost. Throws hl::Error for anything else.
boost::asio::ip::address parseListenAddress(const std::string& text);

/// All but the constructor and port() in the context's thread.
class Listener {
 public:
  /// Listens at once; throws hl::Error when the port is taken or the address is not this machine's.
  Listener(boost::asio::io_context& context, const ListenerSettings& settings);
  std::uint16_t port() const { return port_; }

  void start(ListenerCallbacks callbacks);
  /// Accepts again where that has ended for want of memory.
  void keepAccepting();
  /// No new connections; those with a farewell get it and `grace` to leave, the others are closed.
  void stop(std::chrono::milliseconds grace);

  std::size_t connections() const { return connections_.size(); }
  std::size_t refused() const { return refused_; }  ///< beyond max_connections, since the start

 private:
  class Slot;

  void listen(const ListenerSettings& settings);
  boost::asio::awaitable<void> accept();
  void take(boost::asio::ip::tcp::socket socket);
  void sayCrowdedOut(const boost::asio::ip::tcp::endpoint& peer);
  boost::asio::awaitable<void> admit(std::unique_ptr<Slot> slot);
  boost::asio::awaitable<bool> shakeHands(Connection& connection);
  boost::asio::awaitable<void> closeLater(std::chrono::milliseconds grace);

  boost::asio::io_context& context_;
  ListenerSettings settings_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  std::uint16_t port_ = 0;
  ListenerCallbacks callbacks_;
  std::set<ConnectionPointer> connections_;
  std::size_t refused_ = 0;
  std::chrono::steady_clock::time_point crowded_said_{};
  bool accepting_ = false, stopping_ = false;
};

}  // namespace hl
