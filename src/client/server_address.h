// ServerAddress: where an HL server is: hl://HOST[:PORT], or hls:// with TLS.
#pragma once

#include <cstdint>
#include <string>

namespace hl {

struct ServerAddress {
  std::string host;  ///< a name or an address, IPv6 without its brackets
  std::uint16_t port = 1997;
  bool tls = false;

  /// host:port as people write it, for messages and the Host header.
  std::string text() const;
};

/// Throws hl::Error that shows the right form.
ServerAddress parseServerAddress(const std::string& text);

}  // namespace hl
