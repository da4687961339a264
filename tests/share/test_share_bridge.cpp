// Servers that share a world, in one process.
#include <gtest/gtest.h>

#include <cmath>

#include "memory_hub.h"
#include "shared_server.h"
#include "wait_for.h"

namespace hl::test::test_share_bridge {
namespace {

Vec3 placeOf(const Instance& instance) { return instance.shownAt(monotonicNow_ns()).origin; }

constexpr std::size_t kBoth = 2, kFloorThere = 0, kBlockThere = 1;

struct SharedServers : testing::Test {
  std::unique_ptr<SharedServer> add(ServerId id, const std::string& name, std::shared_ptr<const Snapshot> scene) {
    return std::make_unique<SharedServer>(std::make_unique<MemoryHub::Link>(hub, id), id, name, std::move(scene));
  }
  static void waitForBoth(SharedServer& there) {
    waitFor([&] { return there.other(kBoth - 1).has_value(); });
  }
  MemoryHub hub;
};

TEST_F(SharedServers, HaveTheObjectsOfEachOther) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitForBoth(*b);
  EXPECT_EQ(b->other(kFloorThere)->shape->model.positions, a->own(kFloor).shape->model.positions);
  EXPECT_EQ(placeOf(*b->other(kFloorThere)), Vec3(0, -0.05, 0));
  EXPECT_EQ(a->scene()->instances.size(), kBoth);
}

TEST_F(SharedServers, SeeEachOthersHands) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitFor([&] { return a->bridge.view().hands.size() == 1 && b->bridge.view().hands.size() == 1; });
  waitFor([&] { return b->bridge.view().peers.size() == 1 && b->bridge.view().peers[0].name == "anna"; });
  EXPECT_EQ(b->bridge.view().hands[0].server(), "anna");
  EXPECT_TRUE(b->hasReported("server anna is in the world"));
}

TEST_F(SharedServers, ProgramsAreSentTheHandsOfOthers) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  BodiesClient client(b->touch);
  ASSERT_TRUE(client.until([&] { return client.state_.remote_size() == 1; }));
  EXPECT_EQ(client.state_.remote(0).server(), "anna");
  EXPECT_GT(client.state_.remote(0).proxy_radius(), 0);
  hub.cut(1);
  EXPECT_TRUE(client.until([&] { return client.state_.remote_size() == 0; }));
}

TEST_F(SharedServers, ABodyThatHasComeToRestIsAtTheSamePlaceToTheBit) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitForBoth(*b);
  waitFor([&] { return std::abs(placeOf(a->own(kBlock)).y() - kHalf_m) < 1e-3; });
  waitFor([&] {
    const Pose here = a->own(kBlock).shownAt(0), there = b->other(kBlockThere)->shownAt(monotonicNow_ns());
    return here == there && std::abs(here.origin.y() - kHalf_m) < 1e-3;
  });
}

// The first objects of others are brought within reach of hands that have no workspace yet, and of no others.
TEST_F(SharedServers, AHandKeepsTheWorkspaceThatItHas) {
  TouchServerSettings settings = settingsOf();
  settings.touch.world_per_device.reset();
  const auto a = add(1, "anna", floorAndBlock());
  const auto with = [&](ServerId id, const std::string& name) {
    return std::make_unique<SharedServer>(std::make_unique<MemoryHub::Link>(hub, id), id, name, nothing(), settings);
  };
  const auto set = with(2, "bert");
  const Workspace own{Vec3(0.1, 0.2, 0.3), 2};
  set->touch.device().live().setWorkspace(own);
  const auto unset = with(3, "carl");
  waitForBoth(*set);
  waitForBoth(*unset);
  waitFor([&] { return unset->touch.device().live().workspace().world_per_device > 3; });  // the floor has 2 m
  EXPECT_EQ(set->touch.device().live().workspace().origin_W, own.origin_W);
  EXPECT_EQ(set->touch.device().live().workspace().world_per_device, own.world_per_device);
}

TEST_F(SharedServers, WhatAHandPressesOnABodyOfAnotherMovesIt) {
  const auto a = add(1, "anna", floorAndBlock(kNear)), b = add(2, "bert", nothing());
  waitForBoth(*b);
  waitFor([&] { return std::abs(placeOf(*b->other(kBlockThere)).y() - kHalf_m) < 1e-3; });
  b->touch.device().live().setWorkspace({});
  waitFor([&] { return b->bridge.view().counts.items == kBoth; });
  // From the left, at the height of its centre, and through it; again where a busy machine has made a fault meanwhile.
  const double from = -0.08, to = 0.05;
  for (double x = from; placeOf(a->own(kBlock)).x() < 0.01; x = x < to ? x + 1e-4 : from) {
    b->touch.device().hand().setGoal(Vec3(x, x < -0.06 ? 0.1 : 0.015, 0));
    for (SharedServer* server : {a.get(), b.get()}) server->keepOn();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GT(b->bridge.view().counts.pushes_sent, 0);
  EXPECT_GT(a->bridge.view().counts.pushes_taken, 0);
  waitFor([&] { return placeOf(*b->other(kBlockThere)).x() > 0.009; });
}

TEST_F(SharedServers, WhatAKilledServerHadStaysAndItsBodiesGoOnAndComeBackWithIt) {
  const auto c = add(3, "carl", nothing());
  auto a = add(1, "anna", floorAndBlock());
  const auto b = add(2, "bert", nothing());
  waitForBoth(*b);
  waitForBoth(*c);
  hub.cut(1);
  a.reset();
  waitFor([&] { return b->other(kBlockThere)->movesAsBody(); });  // of all that are left it has the lowest number
  waitFor([&] { return b->hasReported("server anna is lost"); });
  waitFor([&] { return b->bridge.view().counts.adopted == kBoth; });
  // It can be lifted from then on by a program of any server, as it could before.
  waitFor([&] { return c->other(kBlockThere)->shownAt(monotonicNow_ns()) == b->other(kBlockThere)->shownAt(0); });
  a = add(7, "anna", floorAndBlock());
  waitFor([&] { return b->other(kBlockThere) && !b->other(kBlockThere)->movesAsBody(); });
  waitFor([&] { return a->own(kBlock).shownAt(0) == b->other(kBlockThere)->shownAt(monotonicNow_ns()); });
  EXPECT_EQ(b->scene()->instances.size(), kBoth);
  EXPECT_EQ(a->scene()->instances.size(), kBoth);
}

TEST_F(SharedServers, OfOneNameTheSecondSharesNothing) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "anna", nothing());
  waitFor([&] { return !b->bridge.view().ended.empty(); });
  EXPECT_TRUE(b->hasReported("--share-name"));
  EXPECT_EQ(a->bridge.view().ended, "");
}

TEST_F(SharedServers, WhatIsThereStaysWhenTheLinkHasEnded) {
  const auto a = add(1, "anna", floorAndBlock()), b = add(2, "bert", nothing());
  waitForBoth(*b);
  hub.end(2);
  waitFor([&] { return b->hasReported("hl-share has ended"); });
  EXPECT_TRUE(b->other(kBlockThere).has_value());
  waitFor([&] { return b->hasReported("hl-share is there again"); });
  EXPECT_EQ(b->bridge.view().ended, "");
  EXPECT_TRUE(b->other(kBlockThere).has_value());
  EXPECT_FALSE(b->other(kBlockThere)->movesAsBody()) << "its owner was there all the time";
}

// What it had sent is sent anew, so that who joins later has it, and what happened meanwhile too.
TEST_F(SharedServers, WhatAServerHasIsSentAgainWhenTheLinkIsBack) {
  const auto a = add(1, "anna", nothing()), b = add(2, "bert", nothing());
  BodiesClient client(a->touch);
  EXPECT_EQ(client.show(blocksFrame(1, {Vec3(0.3, 0.021, 0.3)})), "");
  waitForBoth(*b);
  hub.end(1);
  EXPECT_EQ(client.show(blocksFrame(2, {Vec3(0.3, 0.021, 0.3), Vec3(-0.3, 0.021, 0.3)})), "");
  waitFor([&] { return a->hasReported("hl-share is there again"); });
  const auto c = add(3, "cleo", nothing());
  for (SharedServer* const other : {b.get(), c.get()}) {
    waitFor([&] { return other->scene()->instances.size() == 3; });
    waitFor([&] { return !other->other(1)->movesAsBody() && !other->other(2)->movesAsBody(); });
  }
}

TEST_F(SharedServers, ObjectsOfAClientComeAndGo) {
  const auto a = add(1, "anna", nothing()), b = add(2, "bert", nothing());
  {
    BodiesClient client(a->touch);
    EXPECT_EQ(client.show(blocksFrame(1, {Vec3(0.3, 0.021, 0.3)})), "");
    waitForBoth(*b);
    EXPECT_EQ(client.show(blocksFrame(2, {})), "");
    waitFor([&] { return !b->other(kBlockThere).has_value(); });
    EXPECT_TRUE(b->other(kFloorThere).has_value());
  }
  waitFor([&] { return b->scene()->instances.empty(); });
}

}  // namespace
}  // namespace hl::test::test_share_bridge
