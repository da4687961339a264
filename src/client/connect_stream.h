// connectStream: from an address to a stream that a WebSocket can begin on, with every failure as a line that helps.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ssl/context.hpp>
#include <chrono>
#include <memory>
#include <string>

#include "client/server_address.h"
#include "wire/stream.h"

namespace hl {

/// TLS 1.3, trusting the authorities of `ca_file` (PEM), or the system's when it is empty. Throws hl::Error.
std::unique_ptr<boost::asio::ssl::context> makeClientTls(const std::string& ca_file);

/// Finds the host, connects, and shakes hands when `tls` is not null (it must outlive the stream). Throws hl::Error.
boost::asio::awaitable<std::unique_ptr<Stream>> connectStream(const ServerAddress& address,
                                                              boost::asio::ssl::context* tls,
                                                              std::chrono::nanoseconds patience);

}  // namespace hl
