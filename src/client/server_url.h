// ServerUrl: the argument of hlCreateContext: where the server is and what the client wants of it.
#pragma once

#include <cstdint>
#include <string>

namespace hl::client {

struct ServerUrl {
  std::string scheme;  ///< inproc, hl, hls: who carries the messages
  std::string host;    ///< a name or an address, an IPv6 address without its brackets; empty: no host
  std::uint16_t port = 1997;
  std::string name;   ///< of the client
  std::string token;  ///< empty: none
  std::uint32_t device = 0;
  std::string device_label;  ///< in the place of the number; empty: by the number
  bool master = true;
  bool keep = false;
  double state_rate_Hz = 60;
  double timeout_s = 10;  ///< for the welcome
  std::string ca_file;    ///< hls; empty: the system's certificates
  std::string sim;        ///< inproc: model of the simulated device; empty: whichever there is
};

/// Throws hl::Error with one line that says what is wrong. The defaults of name and token come from the process.
ServerUrl parseServerUrl(const std::string& url);

}  // namespace hl::client
