// Datagrams of handshakes go out several times: in this program sendmsg() is the one of hl-share and hl-ros.
#include "dds/repeated_handshakes.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>

namespace hl::test_repeated_handshakes {
namespace {

class RepeatedHandshakes : public testing::Test {
 protected:
  RepeatedHandshakes() { made_ = socketpair(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0, ends_.data()) == 0; }
  ~RepeatedHandshakes() override {
    for (const int end : ends_) close(end);
  }
  // How often a datagram of these two parts comes.
  int copiesOf(std::string first, std::string second) {
    EXPECT_TRUE(made_);
    std::array<iovec, 2> parts{iovec{first.data(), first.size()}, iovec{second.data(), second.size()}};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    const auto whole = static_cast<ssize_t>(first.size() + second.size());
    EXPECT_EQ(sendmsg(ends_[0], &message, MSG_DONTWAIT), whole);
    int copies = 0;
    for (std::string heard(100, '\0'); recv(ends_[1], heard.data(), heard.size(), MSG_DONTWAIT) == whole; ++copies)
      EXPECT_EQ(heard.substr(0, first.size() + second.size()), first + second);
    return copies;
  }

  const std::string handshake_{"head \x00\x02\x01\xc3 more", 14}, data_{"head \x00\x00\x03\x02 more", 14};

 private:
  std::array<int, 2> ends_{};
  bool made_ = false;
};

// Each test is a process of its own for ctest; in one with others it is the first.
TEST_F(RepeatedHandshakes, NoneIsRepeatedBeforeItIsAskedFor) { EXPECT_EQ(copiesOf("RTPS", handshake_), 1); }

TEST_F(RepeatedHandshakes, EachGoesOutSeveralTimesAndDataOnce) {
  repeatHandshakes();
  EXPECT_EQ(copiesOf("RTPS", handshake_), kHandshakeCopies);
  EXPECT_EQ(copiesOf(handshake_, "more"), kHandshakeCopies);
  EXPECT_EQ(copiesOf("RTPS", data_), 1);
}

}  // namespace
}  // namespace hl::test_repeated_handshakes
