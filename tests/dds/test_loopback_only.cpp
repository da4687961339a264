// Sockets of a program that keeps to this machine: in this program bind() is the one of hl-ros.
#include "dds/loopback_only.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "base/error.h"

namespace hl::test_loopback_only {
namespace {

class Socket {
 public:
  Socket(int family, int type) : descriptor_(socket(family, type | SOCK_CLOEXEC, 0)) {}
  ~Socket() { close(descriptor_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  int descriptor() const { return descriptor_; }
  std::string device() const {
    char name[IFNAMSIZ] = "";
    socklen_t size = sizeof name;
    getsockopt(descriptor_, SOL_SOCKET, SO_BINDTODEVICE, name, &size);
    return name;
  }

 private:
  int descriptor_;
};

int bindAnywhere(const Socket& socket) {
  sockaddr_in anywhere{};
  anywhere.sin_family = AF_INET;
  return bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&anywhere), sizeof anywhere);
}

TEST(LoopbackOnly, ASocketForAllAddressesIsTiedToLo) {
  for (const int type : {SOCK_DGRAM, SOCK_STREAM}) {
    const Socket socket(AF_INET, type);
    ASSERT_EQ(bindAnywhere(socket), 0);
    EXPECT_EQ(socket.device(), "lo");
    EXPECT_NO_THROW(requireLoopbackOnly());
  }
}

TEST(LoopbackOnly, OneOfIpv6IsToo) {
  const Socket socket(AF_INET6, SOCK_DGRAM);
  if (socket.descriptor() < 0) GTEST_SKIP() << "no IPv6 here";
  sockaddr_in6 anywhere{};
  anywhere.sin6_family = AF_INET6;
  ASSERT_EQ(bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&anywhere), sizeof anywhere), 0);
  EXPECT_EQ(socket.device(), "lo");
}

TEST(LoopbackOnly, OneThatIsNotTiedIsRefused) {
  EXPECT_NO_THROW(requireLoopbackOnly());
  const Socket socket(AF_INET, SOCK_DGRAM);
  EXPECT_THROW(requireLoopbackOnly(), Error);
}

TEST(LoopbackOnly, TiedOnesHearEachOther) {
  const Socket sender(AF_INET, SOCK_DGRAM), receiver(AF_INET, SOCK_DGRAM);
  ASSERT_EQ(bindAnywhere(sender), 0);
  ASSERT_EQ(bindAnywhere(receiver), 0);
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(receiver.descriptor(), reinterpret_cast<sockaddr*>(&address), &size);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const char byte = 7;
  EXPECT_EQ(sendto(sender.descriptor(), &byte, 1, 0, reinterpret_cast<const sockaddr*>(&address), size), 1);
  char heard = 0;
  EXPECT_EQ(recv(receiver.descriptor(), &heard, 1, 0), 1);
  EXPECT_EQ(heard, 7);
}

// Each test is a process of its own for ctest; in one with others it is the last.
TEST(LoopbackOnlyEnds, WhereItIsLeftSocketsAreAsOthers) {
  leaveLoopback();
  const Socket socket(AF_INET, SOCK_DGRAM);
  ASSERT_EQ(bindAnywhere(socket), 0);
  EXPECT_EQ(socket.device(), "");
}

TEST(LoopbackOnly, LocalSocketsAreAsTheyWere) {
  const Socket socket(AF_UNIX, SOCK_DGRAM);
  sockaddr_un unnamed{};
  unnamed.sun_family = AF_UNIX;
  EXPECT_EQ(bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&unnamed), sizeof unnamed.sun_family), 0);
  EXPECT_NO_THROW(requireLoopbackOnly());
}

}  // namespace
}  // namespace hl::test_loopback_only
