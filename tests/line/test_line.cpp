// hl_line itself, by UDP sockets in its namespaces. Skipped where namespaces are not allowed.
#include "line/line.h"

#include <gtest/gtest.h>
#include <net/if.h>
#include <signal.h>

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "base/error.h"
#include "line/udp_socket.h"
#include "wait_for.h"

namespace hl::line::test_line {
namespace {

class LineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = lineRefusal()) GTEST_SKIP() << *why;
  }
};

using test::waitFor;

TEST_F(LineTest, PacketsComeInOrderAndNoneBeforeItsTime) {
  Line line(2, "delay 20 jitter 5");
  UdpSocket here(line, 1), there(line, 2);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(here.send(addressOf(2), {i}));
    ASSERT_TRUE(there.send(addressOf(1), {monotonicNow_ns()}));
    const std::int64_t sent_ns = here.await();
    EXPECT_GE(monotonicNow_ns() - sent_ns, 15'000'000);
  }
  for (int i = 0; i < 200; ++i) EXPECT_EQ(there.await(), i);
}

// A busy machine may hold packets up, not all of them: there and back take twice the delay.
TEST_F(LineTest, TheDelayIsHeldWithinAMillisecond) {
  Line line(2, "delay 20");
  UdpSocket here(line, 1), there(line, 2);
  waitFor([&] {
    here.send(addressOf(2), {monotonicNow_ns()});
    there.send(addressOf(1), {there.await()});
    const std::int64_t sent_ns = here.await();
    const std::int64_t way_ns = monotonicNow_ns() - sent_ns;
    EXPECT_GE(way_ns, 40'000'000);
    return way_ns < 41'000'000;
  });
}

TEST_F(LineTest, ExactlyThePacketsOfTheSeedAreLost) {
  constexpr int kCount = 20'000, kTogether = 100;  // so many fit in the buffers of a socket and of line0
  constexpr std::uint64_t kSeed = 7;
  Line line(2, "loss 3", kSeed);
  Hub same(2, kSeed);
  same.obey(orderOf("loss 3", 2));
  UdpSocket here(line, 1), there(line, 2);
  int came = 0;
  for (int sent = 0; sent < kCount;) {
    for (int i = 0; i < kTogether; ++i) ASSERT_TRUE(here.send(addressOf(2), {++sent}));
    // All are through before the next ones come: no buffer is ever full.
    waitFor([&] {
      const LinkCounts counts = line.counts(1, 2);
      while (there.receive()) ++came;
      return counts.taken == static_cast<std::uint64_t>(sent) && counts.given == static_cast<std::uint64_t>(came) &&
             counts.waiting == 0;
    });
  }
  Packet packet(28);
  packet[0] = 0x45;
  const std::string address{10, 77, 0, 2};
  std::copy(address.begin(), address.end(), packet.begin() + 16);
  for (int i = 0; i < kCount; ++i) same.put(1, packet, 0);
  EXPECT_EQ(line.counts(1, 2).lost, same.counts(1, 2).lost);
  EXPECT_EQ(static_cast<std::uint64_t>(came), kCount - same.counts(1, 2).lost);
  EXPECT_NEAR(static_cast<double>(kCount - came), 0.03 * kCount, 4 * std::sqrt(kCount * 0.03 * 0.97));
}

TEST_F(LineTest, NothingComesThroughWhenCutUntilItIsMended) {
  Line line(3);
  UdpSocket first(line, 1), second(line, 2), third(line, 3);
  line.say("cut 2");
  for (int i = 0; i < 10; ++i) {
    first.send(addressOf(2), {i});
    third.send(addressOf(1), {i});
    second.send(addressOf(1), {-1});
  }
  for (int i = 0; i < 10; ++i) EXPECT_EQ(first.await(), i);
  waitFor([&] { return line.counts(1, 2).cut == 10 && line.counts(2, 1).cut == 10; });
  EXPECT_FALSE(second.receive().has_value());
  EXPECT_FALSE(first.receive().has_value());
  line.say("mend 2");
  first.send(addressOf(2), {11});
  EXPECT_EQ(second.await(), 11);
}

TEST_F(LineTest, OneToManyComesToAllOthers) {
  Line line(3);
  UdpSocket first(line, 1), second(line, 2), third(line, 3);
  const std::string group = "239.255.0.1";
  second.join(group);
  third.join(group);
  std::int64_t number = 0;
  for (const std::string& to : {group, std::string("10.77.0.255"), std::string("255.255.255.255")}) {
    ASSERT_TRUE(first.send(to, {++number})) << to;
    EXPECT_EQ(second.await(), number) << to;
    EXPECT_EQ(third.await(), number) << to;
  }
}

TEST_F(LineTest, APacketHasAtMost1500Bytes) {
  Line line(2);
  UdpSocket here(line, 1), there(line, 2);
  EXPECT_TRUE(here.send(addressOf(2), std::vector<std::int64_t>(184, 5)));  // 1472 bytes and 28 of headers
  EXPECT_FALSE(here.send(addressOf(2), std::vector<std::int64_t>(185, 5)));
  EXPECT_EQ(there.await(), 5);
}

TEST_F(LineTest, OrdersCountWhileItRunsAndWrongOnesChangeNothing) {
  Line line(2, "loss 100");
  UdpSocket here(line, 1), there(line, 2);
  here.send(addressOf(2), {1});
  waitFor([&] { return line.counts(1, 2).lost == 1; });
  EXPECT_THROW(line.say("loss 0 delay -1"), Error);
  here.send(addressOf(2), {2});
  waitFor([&] { return line.counts(1, 2).lost == 2; });
  line.say("loss 0");
  here.send(addressOf(2), {3});
  EXPECT_EQ(there.await(), 3);
}

// Whoever ends it, and however: programs in the namespaces are without a device, and the machine is as it was.
TEST_F(LineTest, AKilledLineLeavesNoDevice) {
  Line line(2);
  line.inside(1, [&] {
    EXPECT_NE(if_nametoindex("line0"), 0u);
    kill(line.id(), SIGKILL);
    waitFor([] { return if_nametoindex("line0") == 0; });
  });
  EXPECT_THROW(line.say("count"), Error);
}

TEST_F(LineTest, TheMachinesOwnNetworkSeesNothing) {
  const unsigned before = if_nametoindex("line0");
  Line line(2);
  EXPECT_EQ(if_nametoindex("line0"), before);
  line.inside(1, [] { EXPECT_EQ(if_nametoindex("eth0"), 0u); });
}

}  // namespace
}  // namespace hl::line::test_line
