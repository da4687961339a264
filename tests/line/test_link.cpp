// Links and the hub between them, by times that the test says.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "line/hub.h"

namespace hl::line::test_link {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// A number in so many bytes.
Packet numbered(int number, std::size_t bytes = 100) {
  Packet packet(bytes);
  packet[0] = static_cast<char>(number % 128);
  packet[1] = static_cast<char>(number / 128);
  return packet;
}
int numberOf(const Packet& packet) { return packet[0] + 128 * packet[1]; }

/// When each packet came out, by its number, in the order in which they came; what comes is asked for at each moment
/// at which something is due.
struct Arrival {
  int number;
  std::int64_t time_ns;
};
std::vector<Arrival> arrivals(Link& link) {
  std::vector<Arrival> all;
  while (link.due_ns() != Link::kNever_ns) {
    const std::int64_t due_ns = link.due_ns();
    EXPECT_FALSE(link.take(due_ns - 1).has_value());
    while (const auto packet = link.take(due_ns)) all.push_back({numberOf(*packet), due_ns});
  }
  return all;
}

Link linkWith(const LinkSettings& settings, std::uint64_t seed = 1) {
  Link link(seed);
  link.set(settings);
  return link;
}

TEST(Link, EachPacketComesAfterTheDelay) {
  Link link = linkWith({.delay_ms = 50});
  for (int i = 0; i < 100; ++i) link.put(numbered(i), i * kMs);
  const auto all = arrivals(link);
  ASSERT_EQ(all.size(), 100u);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(all[static_cast<std::size_t>(i)].number, i);
    EXPECT_EQ(all[static_cast<std::size_t>(i)].time_ns, (i + 50) * kMs);
  }
}

TEST(Link, JitterIsUniformAndWithoutReorderingKeepsTheOrder) {
  for (const bool reorder : {false, true}) {
    Link link = linkWith({.delay_ms = 50, .jitter_ms = 5, .reorder = reorder});
    const int count = 10'000;
    for (int i = 0; i < count; ++i) link.put(numbered(i), i * kMs);
    const auto all = arrivals(link);
    ASSERT_EQ(all.size(), 10'000u);
    int swapped = 0;
    double sum_ms = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double delay_ms = 1e-6 * static_cast<double>(all[i].time_ns - all[i].number * kMs);
      EXPECT_GE(delay_ms, 45);
      EXPECT_LE(delay_ms, 55);
      sum_ms += delay_ms;
      if (i > 0 && all[i].number < all[i - 1].number) ++swapped;
    }
    if (reorder) {
      EXPECT_GT(swapped, 1000);
      EXPECT_NEAR(sum_ms / count, 50, 5 / std::sqrt(3.0 * count) * 4);  // four standard deviations of the mean
    } else {
      EXPECT_EQ(swapped, 0);
    }
  }
}

TEST(Link, LossIsWithinItsBinomialBoundAndTheSameForASeed) {
  const int count = 100'000;
  std::vector<std::uint64_t> lost;
  for (const std::uint64_t seed : {1, 1, 2}) {
    Link link = linkWith({.loss_percent = 2}, seed);
    for (int i = 0; i < count; ++i) {
      link.put(numbered(0), i);
      link.take(i);
    }
    lost.push_back(link.counts().lost);
    EXPECT_EQ(link.counts().taken, link.counts().given + link.counts().lost);
    EXPECT_NEAR(static_cast<double>(lost.back()), 0.02 * count, 4 * std::sqrt(count * 0.02 * 0.98));
  }
  EXPECT_EQ(lost[0], lost[1]);
  EXPECT_NE(lost[0], lost[2]);
}

TEST(Link, ARateSpacesPacketsByTheirBits) {
  Link link = linkWith({.delay_ms = 10, .rate_Mbit_s = 8});  // a byte in a microsecond
  for (int i = 0; i < 3; ++i) link.put(numbered(i, 1500), 0);
  link.put(numbered(3, 500), 20 * kMs);  // the line is free again
  const auto all = arrivals(link);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].time_ns, 10 * kMs + 1'500'000);
  EXPECT_EQ(all[1].time_ns, 10 * kMs + 3'000'000);
  EXPECT_EQ(all[2].time_ns, 10 * kMs + 4'500'000);
  EXPECT_EQ(all[3].time_ns, 30 * kMs + 500'000);
}

TEST(Link, ACutTakesAllThatIsOnItsWay) {
  Link link = linkWith({.delay_ms = 10});
  link.put(numbered(0), 0);
  link.cut(true);
  link.put(numbered(1), 0);
  EXPECT_EQ(link.due_ns(), Link::kNever_ns);
  link.cut(false);
  link.put(numbered(2), 0);
  const auto all = arrivals(link);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].number, 2);
  EXPECT_EQ(link.counts().cut, 2u);
}

TEST(Link, WhatIsOnItsWayIsBounded) {
  Link link = linkWith({.delay_ms = 10});
  for (std::size_t i = 0; i < Link::kMaxWaiting + 5; ++i) link.put(numbered(0), 0);
  EXPECT_EQ(link.counts().full, 5u);
  EXPECT_EQ(link.counts().waiting, Link::kMaxWaiting);
}

TEST(Link, ASmallerDelayLetsNoPacketPassAnother) {
  Link link = linkWith({.delay_ms = 50});
  link.put(numbered(0), 0);
  link.set({.delay_ms = 1});
  link.put(numbered(1), 0);
  const auto all = arrivals(link);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].number, 0);
  EXPECT_EQ(all[1].time_ns, 50 * kMs);
}

Packet packetTo(std::array<int, 4> address) {
  Packet packet(28);
  packet[0] = 0x45;
  packet[9] = 17;  // UDP
  for (std::size_t i = 0; i < 4; ++i) packet[16 + i] = static_cast<char>(address[i]);
  return packet;
}

std::vector<int> endsThatGet(Hub& hub, const Packet& packet) {
  std::vector<int> got;
  hub.put(2, packet, 0);
  hub.give(0, [&](int end, const Packet&) { got.push_back(end); });
  return got;
}

TEST(Hub, APacketGoesToItsAddressAndOneToManyToAllOthers) {
  Hub hub(3, 1);
  EXPECT_EQ(endsThatGet(hub, packetTo({10, 77, 0, 1})), std::vector{1});
  EXPECT_EQ(endsThatGet(hub, packetTo({10, 77, 0, 3})), std::vector{3});
  const std::vector others{1, 3};
  EXPECT_EQ(endsThatGet(hub, packetTo({10, 77, 0, 255})), others);
  EXPECT_EQ(endsThatGet(hub, packetTo({255, 255, 255, 255})), others);
  EXPECT_EQ(endsThatGet(hub, packetTo({239, 255, 0, 1})), others);
  hub.obey(orderOf("multicast off", 3));
  EXPECT_TRUE(endsThatGet(hub, packetTo({239, 255, 0, 1})).empty());
  for (const int end : {0, 2, 4}) EXPECT_TRUE(endsThatGet(hub, packetTo({10, 77, 0, end})).empty());
  EXPECT_TRUE(endsThatGet(hub, packetTo({8, 8, 8, 8})).empty());
  EXPECT_TRUE(endsThatGet(hub, {}).empty());
  Packet ipv6 = packetTo({10, 77, 0, 1});
  ipv6[0] = 0x60;
  EXPECT_TRUE(endsThatGet(hub, ipv6).empty());
}

TEST(Hub, AnOrderChangesTheDirectionsThatItNames) {
  Hub hub(3, 1);
  hub.obey(orderOf("from 2 to 1 loss 100", 3));
  EXPECT_TRUE(endsThatGet(hub, packetTo({10, 77, 0, 1})).empty());
  EXPECT_EQ(endsThatGet(hub, packetTo({10, 77, 0, 3})), std::vector{3});
  hub.obey(orderOf("cut 3", 3));
  EXPECT_TRUE(endsThatGet(hub, packetTo({10, 77, 0, 3})).empty());
  hub.obey(orderOf("mend 3", 3));
  EXPECT_EQ(endsThatGet(hub, packetTo({10, 77, 0, 3})), std::vector{3});
  EXPECT_EQ(hub.counts(2, 1).lost, 1u);
  EXPECT_EQ(hub.counts(2, 3).cut, 1u);
}

TEST(Hub, AnOrderThatCannotBeDoneChangesNothing) {
  Hub hub(3, 1);
  hub.obey(orderOf("from 1 to 2 delay 10 jitter 5", 3));
  EXPECT_THROW(hub.obey(orderOf("loss 100 delay 3", 3)), Error);  // below the jitter of one direction
  EXPECT_EQ(endsThatGet(hub, packetTo({10, 77, 0, 1})), std::vector{1});
}

TEST(Hub, WhatIsNoOrderIsRefused) {
  for (const char* text :
       {"", "delay", "delay x", "delay nan", "delay -1", "loss 101", "loss inf", "rate -1", "reorder 1", "multicast 1",
        "cut", "cut 4", "cut 0", "cut 1.5", "cut 1 2", "from 9 delay 1", "speed 3", "count 1"})
    EXPECT_THROW(orderOf(text, 3), Error) << text;
}

}  // namespace
}  // namespace hl::line::test_link
