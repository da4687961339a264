// Connection: one accepted socket on its way through the server, and what all of them share.
#pragma once

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "wire/stream.h"

namespace hl {

/// Errors of asynchronous operations as values. What is awaited gets a name before it is tested: GCC 12 makes wrong
/// code of a co_await inside a condition.
inline constexpr auto kAwait = boost::asio::as_tuple(boost::asio::use_awaitable);

struct Connection {
  Connection(Stream::Tcp tcp, boost::asio::ssl::context* tls, std::string peer_name)
      : stream(std::move(tcp), tls), peer(std::move(peer_name)) {}

  Stream stream;
  std::string peer;  ///< address:port, for the logs
  /// How to end it politely when the server stops; without one it is closed.
  std::function<void()> farewell;
};
using ConnectionPointer = std::shared_ptr<Connection>;

/// Beast's strings as the standard's.
template <typename BeastString>
std::string_view viewOf(const BeastString& s) {
  return {s.data(), s.size()};
}

}  // namespace hl
