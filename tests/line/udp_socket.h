// UdpSocket: at an end of a line, port 7000. For tests of one thread, which hold both sides.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "line/line.h"

namespace hl::line {

class UdpSocket {
 public:
  static constexpr std::uint16_t kPort = 7000;

  UdpSocket(const Line& line, int end) {
    line.inside(end, [&] { descriptor_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); });
    const int yes = 1, whole = IP_PMTUDISC_DO;
    setsockopt(descriptor_, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
    setsockopt(descriptor_, IPPROTO_IP, IP_MTU_DISCOVER, &whole, sizeof whole);
    const sockaddr_in here = address("0.0.0.0");
    if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0)
      throw Error(std::string("no UDP socket: ") + std::strerror(errno));
  }
  ~UdpSocket() { close(descriptor_); }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  void join(const std::string& group) {
    ip_mreq request{};
    request.imr_multiaddr = address(group).sin_addr;
    setsockopt(descriptor_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request);
  }
  /// Whether the kernel has taken it.
  bool send(const std::string& to, const std::vector<std::int64_t>& numbers) {
    const sockaddr_in there = address(to);
    const std::size_t size = numbers.size() * sizeof numbers[0];
    return sendto(descriptor_, numbers.data(), size, 0, reinterpret_cast<const sockaddr*>(&there), sizeof there) >= 0;
  }
  /// The first number of a packet that has come.
  std::optional<std::int64_t> receive() {
    std::int64_t number = 0;
    if (recv(descriptor_, &number, sizeof number, 0) < 0) return std::nullopt;
    return number;
  }
  std::int64_t await() {
    for (;;) {
      pollfd waiting{descriptor_, POLLIN, 0};
      poll(&waiting, 1, -1);
      if (const auto number = receive()) return *number;
    }
  }

 private:
  static sockaddr_in address(const std::string& text) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(kPort);
    inet_pton(AF_INET, text.c_str(), &address.sin_addr);
    return address;
  }

  int descriptor_ = -1;
};

}  // namespace hl::line
