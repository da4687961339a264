#include "line/line_end.h"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "line/hub.h"

namespace hl::line {

namespace {

std::string reason() { return std::strerror(errno); }

// Without a default route programs could send to many only when they name the device.
void configure(int end) {
  const std::string orders = "link set lo up\nlink set line0 mtu 1500 up\naddr add " + addressOf(end) +
                             "/24 dev line0\nroute add default dev line0\n";
  std::FILE* const ip = popen("ip -batch -", "w");
  if (ip == nullptr) throw Error("ip cannot be started: " + reason());
  std::fputs(orders.c_str(), ip);
  if (pclose(ip) != 0) throw Error("ip (of iproute2) does not configure line0: it has said why");
}

}  // namespace

LineEnd::LineEnd(int end) {
  if (unshare(CLONE_NEWNET) != 0) throw LineRefused("no network namespaces here (root makes them): " + reason());
  name_space_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  device_ = open("/dev/net/tun", O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (device_ < 0) throw LineRefused("no /dev/net/tun here: " + reason());
  ifreq request{};
  std::strcpy(request.ifr_name, "line0");
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  if (ioctl(device_, TUNSETIFF, &request) != 0) throw LineRefused("no TUN devices here: " + reason());
  configure(end);
}

LineEnd::~LineEnd() {
  if (device_ >= 0) close(device_);
  if (name_space_ >= 0) close(name_space_);
}

LineEnd::LineEnd(LineEnd&& other) noexcept
    : name_space_(std::exchange(other.name_space_, -1)), device_(std::exchange(other.device_, -1)) {}

}  // namespace hl::line
