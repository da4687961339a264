// Servers of a shared world, in a time and a network of the test's own.
#include "share/shared_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "share/virtual_world.h"

namespace hl::test::test_shared_world {

namespace {

const Replica* find(const std::vector<Replica>& replicas, ItemId id) {
  const auto found = std::find_if(replicas.begin(), replicas.end(), [&](const Replica& one) { return one.id == id; });
  return found == replicas.end() ? nullptr : &*found;
}

bool hasContents(SharedWorld& world, const Replica& replica) {
  return world.contents().find(nameOf(replica.content->shape())) &&
         world.contents().find(nameOf(replica.content->surfaces()));
}

std::string nameOfLine(const testing::TestParamInfo<Line>& info) {
  return std::to_string(info.param.delay_ns / kMs) + "ms" + std::to_string(static_cast<int>(100 * info.param.loss)) +
         "percent" + std::to_string(info.index);
}

class OnLine : public testing::TestWithParam<Line> {};

INSTANTIATE_TEST_SUITE_P(Lines, OnLine,
                         testing::Values(Line{}, Line{10 * kMs, 5 * kMs, 0.01}, Line{50 * kMs, 20 * kMs, 0.05},
                                         Line{100 * kMs, 30 * kMs, 0}, Line{100 * kMs, 30 * kMs, 0.05}),
                         nameOfLine);

TEST_P(OnLine, AnObjectComesOverWithItsContents) {
  VirtualNet net(GetParam());
  auto& a = net.add("a", 7, 123 * kMs);
  auto& b = net.add("b", 5, -999'999 * kMs);
  a.local[1] = {contentOf(*a.world, "cube", false, 300'001), motionAt({1, 2, 3})};
  net.run(6);
  const std::vector<Replica> there = b.world->replicas(net.nowOf(b));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(there[0].id, 1U);
  EXPECT_EQ(there[0].owner, 7U);
  EXPECT_FALSE(there[0].own);
  EXPECT_EQ(there[0].pose, motionAt({1, 2, 3}).pose);
  EXPECT_EQ(there[0].content->look(), "cube");
  EXPECT_TRUE(hasContents(*b.world, there[0]));
  EXPECT_TRUE(a.world->replicas(net.nowOf(a)).empty());
  EXPECT_GT(b.world->counts(net.nowOf(b)).join_s, 0);
}

// What moves is shown where it was, late by what the line takes and a frame; and exactly where it rests.
TEST_P(OnLine, AMotionIsShownEvenlyAndEndsExactly) {
  VirtualNet net(GetParam());
  auto& a = net.add("a", 7, 123 * kMs);
  auto& b = net.add("b", 5);
  a.local[1] = {contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  net.run(4);
  constexpr double kSpeed_m_s = 0.25;
  double x = 0, latest_s = 0, longest_m = 0, last = 0;
  for (int frame = 0; frame < 240; ++frame) {
    x += 1e-9 * static_cast<double>(kFrame_ns) * kSpeed_m_s;
    a.local[1].motion = motionAt({x, 0, 0});
    net.frame();
    const double shown = b.world->replicas(net.nowOf(b)).at(0).pose.origin.x();
    if (frame > 30) {
      latest_s = std::max(latest_s, (x - shown) / kSpeed_m_s);
      longest_m = std::max(longest_m, std::abs(shown - last));
    }
    last = shown;
  }
  const double line_s = 1e-9 * static_cast<double>(GetParam().delay_ns + GetParam().jitter_ns);
  // A lost packet is a hole of a frame: the next one comes then.
  const double holes_s = GetParam().loss > 0 ? 0.034 : 0;
  EXPECT_LT(latest_s, line_s + 0.034 + holes_s);
  EXPECT_LT(longest_m, kSpeed_m_s * (0.034 + 1.5 * holes_s)) << "it jumps";
  net.run(1);
  EXPECT_EQ(b.world->replicas(net.nowOf(b)).at(0).pose, a.local[1].motion.pose) << "to the bit, a second later";
}

TEST_P(OnLine, WhoJoinsLaterSeesAll) {
  VirtualNet net(GetParam());
  auto& a = net.add("a", 7);
  net.add("b", 5);
  for (ItemId id = 1; id <= 20; ++id)
    a.local[id] = {contentOf(*a.world, "object " + std::to_string(id), false, 20'000), motionAt({1.0 * id, 0, 0})};
  net.run(5);
  auto& c = net.add("c", 6, 77 * kMs);
  net.run(8);
  const std::vector<Replica> there = c.world->replicas(net.nowOf(c));
  ASSERT_EQ(there.size(), 20U);
  for (const Replica& replica : there) {
    EXPECT_TRUE(hasContents(*c.world, replica));
    EXPECT_EQ(replica.pose, motionAt({static_cast<double>(replica.id), 0, 0}).pose);
  }
}

// The owner is gone, and with it what it had: another server has the contents.
TEST_P(OnLine, WhoJoinsAfterTheOwnerIsLostSeesAll) {
  VirtualNet net(GetParam());
  auto& a = net.add("a", 7);
  net.add("b", 5);
  a.local[1] = {contentOf(*a.world, "cube", false, 50'000), motionAt({1, 2, 3})};
  net.run(5);
  net.kill(a);
  net.run(2);
  auto& c = net.add("c", 9);
  net.run(5);
  const std::vector<Replica> there = c.world->replicas(net.nowOf(c));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(there[0].owner, 5U);
  EXPECT_TRUE(hasContents(*c.world, there[0]));
  EXPECT_EQ(there[0].pose, motionAt({1, 2, 3}).pose);
}

TEST_P(OnLine, PushesArriveOnceEach) {
  VirtualNet net(GetParam());
  auto& a = net.add("a", 7);
  auto& b = net.add("b", 5);
  a.local[1] = {contentOf(*a.world, "cube", true), motionAt({0, 0, 0})};
  net.run(4);
  Vec3 given = Vec3::Zero(), taken = Vec3::Zero();
  for (int frame = 0; frame < 200; ++frame) {
    const Vec3 impulse(0.001 * frame, -0.5, 0.25);
    b.world->press({1, impulse, {0.01, 0, 0}, 0.0167});
    given += impulse;
    net.frame();
    for (const ItemPush& push : a.world->takePushes()) taken += push.impulse_N_s;
  }
  net.run(3);
  for (const ItemPush& push : a.world->takePushes()) taken += push.impulse_N_s;
  EXPECT_LT((given - taken).norm(), 1e-9);
  EXPECT_EQ(a.world->counts(net.nowOf(a)).pushes_taken, 200U);
}

TEST(SharedWorld, WhatIsDeletedGoesEverywhere) {
  VirtualNet net({20 * kMs, 0, 0.05});
  auto& a = net.add("a", 7);
  auto& b = net.add("b", 5);
  a.local[1] = {contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  a.local[2] = {contentOf(*a.world, "ball"), motionAt({0, 0, 0})};
  net.run(3);
  ASSERT_EQ(b.world->replicas(net.nowOf(b)).size(), 2U);
  a.local.erase(1);
  net.run(1);
  const std::vector<Replica> there = b.world->replicas(net.nowOf(b));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(there[0].id, 2U);
  net.run(2);
  auto& c = net.add("c", 9);
  net.run(2);
  EXPECT_EQ(c.world->replicas(net.nowOf(c)).size(), 1U);
}

// As a program's objects that are all replaced, and again: others hear of the new ones before the old ones are gone.
TEST(SharedWorld, WhatIsDeletedTakesNoRoomOfWhatComes) {
  VirtualNet net({});
  auto& a = net.add("a", 7);
  auto& b = net.add("b", 5);
  const LocalItem cube{contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  for (ItemId first = 1; first <= 4; ++first) {
    a.local.clear();
    for (ItemId i = 0; i < SharedWorld::kMaxItems; ++i) a.local[first + 4 * i] = cube;
    net.run(0.3);
    ASSERT_EQ(b.world->replicas(net.nowOf(b)).size(), SharedWorld::kMaxItems) << first;
    EXPECT_EQ(b.world->counts(net.nowOf(b)).left_out, 0U);
  }
}

TEST(SharedWorld, WhatItHasNoRoomForIsLeftOutAndTheRestStays) {
  VirtualNet net({});
  auto& b = net.add("b", 5);
  for (ServerId id = 7; id < 10; ++id) {
    auto& one = net.add("server" + std::to_string(id), id);
    const LocalItem cube{contentOf(*one.world, "cube"), motionAt({0, 0, 0})};
    for (ItemId i = 1; i <= SharedWorld::kMaxItems; ++i) one.local[id * 100'000 + i] = cube;
  }
  net.run(0.3);
  EXPECT_EQ(b.world->replicas(net.nowOf(b)).size(), 2 * SharedWorld::kMaxItems);
  EXPECT_EQ(b.world->counts(net.nowOf(b)).left_out, SharedWorld::kMaxItems);
}

// A server writes its contents before it publishes the objects that have them.
TEST(SharedWorld, ContentsThatAreHeldElsewhereStayUntilTheirObjectIsPublished) {
  VirtualNet net({});
  auto& a = net.add("a", 7);
  auto& b = net.add("b", 5);
  const auto cube = contentOf(*a.world, "cube");
  const std::vector<Content> held = {a.world->contents().find(nameOf(cube->shape())),
                                     a.world->contents().find(nameOf(cube->surfaces()))};
  net.run(0.5);
  a.local[1] = {cube, motionAt({0, 0, 0})};
  net.run(2);
  const std::vector<Replica> there = b.world->replicas(net.nowOf(b));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_TRUE(hasContents(*b.world, there[0]));
}

TEST(SharedWorld, AnotherContentTakesThePlaceOfTheOldOne) {
  VirtualNet net({20 * kMs, 0, 0});
  auto& a = net.add("a", 7);
  auto& b = net.add("b", 5);
  a.local[1] = {contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  net.run(2);
  const auto before = b.world->replicas(net.nowOf(b)).at(0).content;
  a.local[1].content = contentOf(*a.world, "ball");
  net.run(1);
  const std::vector<Replica> there = b.world->replicas(net.nowOf(b));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(there[0].content->look(), "ball");
  EXPECT_NE(there[0].content, before);
  EXPECT_TRUE(hasContents(*b.world, there[0]));
  EXPECT_FALSE(b.world->contents().find(nameOf(before->shape()))) << "what nobody needs is not kept";
}

// An owner is lost while its body flies: it stops, one server takes it over with its velocity, and all agree on it.
TEST(SharedWorld, ALostBodyIsTakenOverByOne) {
  VirtualNet net({20 * kMs, 5 * kMs, 0.01});
  auto& a = net.add("a", 3);
  auto& b = net.add("b", 5);
  auto& c = net.add("c", 9);
  a.local[1] = {contentOf(*a.world, "cube", true), motionAt({0, 0, 0})};
  net.run(2);
  for (int frame = 0; frame < 60; ++frame) {
    a.local[1].motion.pose.origin.x() += 0.01;
    a.local[1].motion.velocity_m_s = {0.6, 0, 0};
    net.frame();
  }
  const double x = a.local[1].motion.pose.origin.x();
  net.kill(a);
  net.run(1);
  const Replica at_b = *find(b.world->replicas(net.nowOf(b)), 1), at_c = *find(c.world->replicas(net.nowOf(c)), 1);
  EXPECT_TRUE(at_b.own) << "of those that are there it has the lowest number";
  EXPECT_FALSE(at_c.own);
  EXPECT_EQ(at_c.owner, 5U);
  EXPECT_NEAR(at_b.begin.pose.origin.x(), x, 0.02);
  EXPECT_NEAR(at_b.begin.velocity_m_s.x(), 0.6, 1e-6);
  EXPECT_EQ(at_b.pose, at_c.pose);
  EXPECT_EQ(b.world->counts(net.nowOf(b)).adopted, 1U);
}

TEST(SharedWorld, NobodyTakesOverWhereNobodyWants) {
  VirtualNet net({});
  auto& a = net.add("a", 3);
  auto& b = net.add("b", 5, 0, false);
  a.local[1] = {contentOf(*a.world, "cube", true), motionAt({1, 0, 0})};
  net.run(2);
  net.kill(a);
  net.run(2);
  const std::vector<Replica> there = b.world->replicas(net.nowOf(b));
  ASSERT_EQ(there.size(), 1U) << "it stays, and can be touched";
  EXPECT_FALSE(there[0].own);
  EXPECT_EQ(there[0].pose, motionAt({1, 0, 0}).pose);
}

// A server that is started anew has its scene back as the others left it, and what its clients had is gone with them.
TEST(SharedWorld, AServerThatIsBackTakesItsSceneBack) {
  VirtualNet net({20 * kMs, 0, 0});
  auto* a = &net.add("a", 3);
  auto& b = net.add("b", 5);
  a->local[1] = {contentOf(*a->world, "of the scene", true), motionAt({0, 0, 0})};
  a->local[2] = {contentOf(*a->world, "of a client"), motionAt({5, 0, 0})};
  net.run(2);
  net.kill(*a);
  net.run(1);
  b.local[1] = {nullptr, motionAt({2, 0, 0})};  // it falls on, and comes to rest there
  net.run(1);
  a = &net.add("a", 8);
  a->local[1] = {contentOf(*a->world, "of the scene", true), motionAt({0, 0, 0})};
  net.frame();
  net.run(0.5);
  const std::vector<ReturnedItem> returned = a->world->takeReturned();
  ASSERT_EQ(returned.size(), 1U);
  EXPECT_EQ(returned[0].id, 1U);
  EXPECT_EQ(returned[0].motion.pose, motionAt({2, 0, 0}).pose);
  a->local[1].motion = returned[0].motion;
  b.local.clear();
  net.run(4);
  const std::vector<Replica> there = b.world->replicas(net.nowOf(b));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(there[0].id, 1U);
  EXPECT_EQ(there[0].owner, 8U);
  EXPECT_EQ(there[0].pose, motionAt({2, 0, 0}).pose);
  EXPECT_TRUE(a->world->replicas(net.nowOf(*a)).empty());
}

// The line between two halves is cut, both take over; then it is mended, and all agree again.
TEST(SharedWorld, HalvesThatWereCutAgreeWhenTheyMeet) {
  VirtualNet net({20 * kMs, 5 * kMs, 0.01});
  auto& a = net.add("a", 3);
  auto& b = net.add("b", 5);
  auto& c = net.add("c", 9);
  a.local[1] = {contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  net.run(2);
  net.cut(c, 1);
  net.run(2);
  EXPECT_TRUE(c.world->replicas(net.nowOf(c)).at(0).own) << "c knows of nobody else";
  net.kill(a);
  net.run(2);
  EXPECT_TRUE(b.world->replicas(net.nowOf(b)).at(0).own);
  net.cut(c, 0);
  net.run(3);
  EXPECT_EQ(b.world->replicas(net.nowOf(b)).at(0).owner, c.world->replicas(net.nowOf(c)).at(0).owner);
  EXPECT_NE(b.world->replicas(net.nowOf(b)).at(0).own, c.world->replicas(net.nowOf(c)).at(0).own);
}

TEST(SharedWorld, OthersKeepWhatTheyHaveWhenTheOwnLinkWasAway) {
  VirtualNet net({20 * kMs, 5 * kMs, 0.01});
  auto& a = net.add("a", 3);
  auto& b = net.add("b", 5);
  a.local[1] = {contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  net.run(2);
  const std::int64_t now_ns = net.nowOf(b), later_ns = now_ns + 10'000 * kMs;
  b.world->linkAgain(now_ns, later_ns);
  EXPECT_TRUE(b.world->peers().isThere(3, later_ns));
  b.world->step(later_ns);
  EXPECT_FALSE(b.world->replicas(later_ns).at(0).own);
  b.world->step(later_ns + Peers::kLease_ns);
  EXPECT_TRUE(b.world->replicas(later_ns + Peers::kLease_ns).at(0).own) << "it is not heard again";
}

TEST(SharedWorld, HandsAreThereAndGo) {
  VirtualNet net({20 * kMs, 5 * kMs, 0.01});
  auto& a = net.add("a", 3);
  auto& b = net.add("b", 5);
  proto::OtherDevice hand;
  hand.set_label("a");
  hand.mutable_finger()->set_x(0.125);
  for (int frame = 0; frame < 30; ++frame) {
    a.world->publishHand(0, hand, net.nowOf(a));
    net.frame();
  }
  ASSERT_TRUE(b.world->peers().all().contains(3));
  EXPECT_EQ(b.world->peers().all().at(3).hands.at(0).hand().finger().x(), 0.125);
  net.kill(a);
  net.run(1);
  EXPECT_FALSE(b.world->peers().isThere(3, net.nowOf(b)));
}

TEST(SharedWorld, ASecondServerOfTheSameNameIsNoticed) {
  VirtualNet net({});
  auto& a = net.add("a", 3);
  auto& twin = net.add("a", 5);
  net.run(1);
  EXPECT_EQ(a.world->peers().sameName(net.nowOf(a)), nullptr) << "it may have ended a moment ago";
  net.run(4);
  EXPECT_NE(a.world->peers().sameName(net.nowOf(a)), nullptr);
  EXPECT_NE(twin.world->peers().sameName(net.nowOf(twin)), nullptr);
  EXPECT_FALSE(a.world->peers().isSecondOfItsName(net.nowOf(a)));
  EXPECT_TRUE(twin.world->peers().isSecondOfItsName(net.nowOf(twin)));
}

TEST(SharedWorld, OfTwoServersOfOneNameTheSecondLeavesWhateverItsNumberAndClock) {
  VirtualNet net({});
  auto& first = net.add("a", 9, 5'000'000'000);
  net.run(2);
  auto& second = net.add("a", 4);
  net.run(5);
  EXPECT_FALSE(first.world->peers().isSecondOfItsName(net.nowOf(first)));
  EXPECT_TRUE(second.world->peers().isSecondOfItsName(net.nowOf(second)));
}

TEST(SharedWorld, ItSurvivesWhatMakesNoSense) {
  VirtualNet net({});
  auto& a = net.add("a", 3);
  a.local[1] = {contentOf(*a.world, "cube"), motionAt({0, 0, 0})};
  net.run(1);
  std::mt19937 random(5);
  const auto number = [&] { return std::uniform_int_distribution<std::uint32_t>(0, 255)(random); };
  for (int i = 0; i < 20'000; ++i) {
    std::string bytes;
    for (std::uint32_t length = number() % 64; length > 0; --length) bytes += static_cast<char>(number());
    a.world->hear({static_cast<Lane>(number() % 3), 3, bytes}, net.nowOf(a));
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {kNaN, 1e300, std::numeric_limits<double>::infinity()}) {
    proto::ShareMessage message;
    proto::ShareItem& item = *message.mutable_item();
    item.set_id(9);
    item.set_epoch(1);
    item.set_owner(5);
    *item.mutable_content() = *a.local[1].content;
    toProto(motionAt({bad, 0, 0}), *item.mutable_motion());
    a.world->hear({Lane::kItems, 9, message.SerializeAsString()}, net.nowOf(a));
  }
  proto::ShareMessage push;
  push.mutable_push()->set_from(5);
  push.mutable_push()->set_id(1);
  push.mutable_push()->set_number(1);
  push.mutable_push()->mutable_impulse_n_s()->set_x(kNaN);
  a.world->hear({Lane::kInbox, 3, push.SerializeAsString()}, net.nowOf(a));
  net.run(1);
  EXPECT_TRUE(a.world->replicas(net.nowOf(a)).empty());
  EXPECT_TRUE(a.world->takePushes().empty());
  EXPECT_GT(a.world->counts(net.nowOf(a)).refused, 0U);
}

// Servers come and go at random, a thousand times: those that are there agree on every owner and place a second later,
// what was defined stays until its definer deletes it, and nothing is ever shown elsewhere at once.
TEST(SharedWorld, OwnersAreLostAThousandTimes) {
  std::mt19937 random(11);
  const auto choose = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  VirtualNet net({20 * kMs, 10 * kMs, 0.02}, 3);
  ServerId next = 100;
  const auto start = [&](const std::string& name) {
    auto& node = net.add(name, splitmix64(next++));
    const ItemId id = 1 + static_cast<ItemId>(name[0] - 'a');
    node.local[id] = {contentOf(*node.world, name, true), motionAt({1.0 * id, 0, 0})};
  };
  for (const char* name : {"a", "b", "c"}) start(name);
  net.run(2);
  for (int round = 0; round < 1000; ++round) {
    const auto& victim = *net.nodes()[choose(net.nodes().size())];
    const std::string name = victim.self.name;
    net.kill(victim);
    net.run(0.3 + 0.1 * static_cast<double>(choose(12)));
    start(name);
    net.run(0.1 * static_cast<double>(choose(10)));
    if (round % 20 != 0) continue;
    net.run(4);
    for (ItemId id = 1; id <= 3; ++id) {
      std::set<ServerId> owners;
      for (const auto& node : net.nodes()) {
        if (node->local.contains(id)) continue;
        const std::vector<Replica> there = node->world->replicas(net.nowOf(*node));
        ASSERT_NE(find(there, id), nullptr) << "round " << round << ": an object is lost";
        EXPECT_EQ(find(there, id)->pose, motionAt({1.0 * id, 0, 0}).pose) << "round " << round;
        owners.insert(find(there, id)->owner);
      }
      EXPECT_EQ(owners.size(), 1U) << "round " << round << ", object " << id;
    }
  }
}

}  // namespace

}  // namespace hl::test::test_shared_world
