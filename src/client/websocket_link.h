// WebsocketLink: a client's link to a server on this machine or over the network. A thread of its own moves the bytes,
// so a program that computes for a second neither stalls its uploads nor loses its session.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "client/server_address.h"
#include "wire/link.h"

namespace hl {

struct WebsocketLinkSettings {
  std::string ca_file;    ///< PEM: whom to trust with hls://; empty: the system's authorities
  double connect_s = 5;   ///< to connect and to shake hands, each; the system's own patience finds the host
  double silence_s = 20;  ///< a server that is silent for so long, pings too, has gone
  double linger_s = 5;    ///< at the end: how long one message may take to leave before the rest is given up
  std::size_t queue_bytes = std::size_t{1} << 30;   ///< sent and not yet with the server; beyond it the link ends
  std::size_t reply_bytes = std::size_t{16} << 20;  ///< of one reply
  std::size_t replies = 65'536;                     ///< that wait to be taken; beyond it the link ends
};

/// Connects and returns when messages can be sent; the session itself begins
/// with the first one, Open. Throws hl::Error with one line that says what is wrong and what to do.
std::unique_ptr<Link> connectWebsocket(const ServerAddress& address, const WebsocketLinkSettings& settings = {});

}  // namespace hl
