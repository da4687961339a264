#include "dds/loopback_only.h"

#include <net/if.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace {

constexpr std::string_view kLoopback = "lo";

bool tied = true;

bool isTied(int descriptor) {
  std::array<char, IFNAMSIZ> device{};
  socklen_t size = device.size();
  return getsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, device.data(), &size) == 0 && device.data() == kLoopback;
}

// Of the internet; a descriptor of something else has no such family.
bool isOfNetwork(int descriptor) {
  int family = 0;
  socklen_t size = sizeof family;
  if (getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &family, &size) != 0) return false;
  return family == AF_INET || family == AF_INET6;
}

}  // namespace

// In the place of the C library's, for all libraries of the program. Linux lets anybody tie a socket, since 5.7.
extern "C" [[gnu::visibility("default")]] int bind(int descriptor, const sockaddr* address, socklen_t size) noexcept {
  if (tied && isOfNetwork(descriptor) &&
      setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, kLoopback.data(), kLoopback.size()) != 0)
    return -1;
  return static_cast<int>(syscall(SYS_bind, descriptor, address, size));
}

namespace hl {

void leaveLoopback() { tied = false; }

void requireLoopbackOnly() {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename().string());
    if (tied && isOfNetwork(descriptor) && !isTied(descriptor))
      throw Error(
          "what is told by DDS stays on this machine, and a socket of Cyclone DDS would not: it needs Linux 5.7");
  }
}

}  // namespace hl
