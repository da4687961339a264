// Stream: a TCP connection, or TLS over one, as one type, so that whatever speaks HTTP or WebSockets over it is
// compiled once and is the same for both. Used at both ends.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <optional>
#include <utility>

namespace hl {

/// An AsyncStream of Boost.Beast. One thread, or strand, at a time.
class Stream {
 public:
  using Tcp = boost::beast::tcp_stream;
  using Tls = boost::asio::ssl::stream<Tcp&>;
  using executor_type = Tcp::executor_type;  // NOLINT(readability-identifier-naming): the name that Asio looks for

  /// `tls` must outlive this; null: plain TCP.
  Stream(Tcp tcp, boost::asio::ssl::context* tls) : tcp_(std::move(tcp)) {
    if (tls != nullptr) tls_.emplace(tcp_, *tls);
  }
  Stream(const Stream&) = delete;  // tls_ refers to tcp_
  Stream& operator=(const Stream&) = delete;

  executor_type get_executor() { return tcp_.get_executor(); }
  Tcp& tcp() { return tcp_; }
  /// Null for plain TCP. The handshake is its owner's work.
  Tls* tls() { return tls_ ? &*tls_ : nullptr; }
  /// At once, without a word to the peer: every operation under way ends with an error.
  void close() { tcp_.close(); }

  template <typename Buffers, typename Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) return tls_->async_read_some(buffers, std::forward<Handler>(handler));
    return tcp_.async_read_some(buffers, std::forward<Handler>(handler));
  }
  template <typename Buffers, typename Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) return tls_->async_write_some(buffers, std::forward<Handler>(handler));
    return tcp_.async_write_some(buffers, std::forward<Handler>(handler));
  }

  /// How Beast ends a stream whose time is up, and the one whose WebSocket has said goodbye.
  friend void beast_close_socket(Stream& stream) { stream.close(); }
  template <typename Handler>
  friend void async_teardown(boost::beast::role_type role, Stream& stream, Handler&& handler) {
    using boost::beast::websocket::async_teardown;
    if (stream.tls_) {
      async_teardown(role, *stream.tls_, std::forward<Handler>(handler));
    } else {
      async_teardown(role, stream.tcp_, std::forward<Handler>(handler));
    }
  }

 private:
  Tcp tcp_;
  std::optional<Tls> tls_;
};

}  // namespace hl
