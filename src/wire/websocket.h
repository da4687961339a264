// Websocket: Boost.Beast's WebSocket over a Stream. Its operations are compiled here once, for the server's clients and
// pages and for the client library: no other code of the network takes a compiler as long.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/error.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream_base.hpp>
#include <boost/system/error_code.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>

namespace hl {

class Stream;

/// One thread, or strand, at a time; one read and one write may be under way at once. Errors come as values.
class Websocket {
 public:
  using Outcome = boost::asio::awaitable<std::tuple<boost::system::error_code>>;
  using Transfer = boost::asio::awaitable<std::tuple<boost::system::error_code, std::size_t>>;

  /// `stream` is connected, and outlives this.
  explicit Websocket(Stream& stream);
  ~Websocket();
  Websocket(const Websocket&) = delete;
  Websocket& operator=(const Websocket&) = delete;

  void setTimeout(const boost::beast::websocket::stream_base::timeout& timeout);
  void setReadLimit(std::size_t bytes);  ///< of one message; 0: none
  void setPieceSize(std::size_t bytes);  ///< of a written message, in one frame
  void setText(bool text);               ///< of the messages written from now on; else binary
  bool gotText() const;                  ///< of the message read last
  bool isMessageDone() const;            ///< its last piece has been read
  std::string peerReason() const;        ///< why the peer has closed; empty: it has not, or does not say

  /// Answers the request that asks for a WebSocket.
  Outcome accept(const boost::beast::http::request<boost::beast::http::string_body>& request);
  /// Asks a server for one; `response` is what it answered.
  Outcome shakeHands(boost::beast::websocket::response_type& response, const std::string& host,
                     const std::string& target);
  /// A piece of a message, at most so many bytes, behind what `buffer` has.
  Transfer readSome(boost::beast::flat_buffer& buffer, std::size_t most_bytes);
  Transfer read(boost::beast::flat_buffer& buffer);   ///< a whole message
  Transfer write(boost::asio::const_buffer message);  ///< a whole message; it stays where it is until then
  Outcome close(const boost::beast::websocket::close_reason& reason);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hl
