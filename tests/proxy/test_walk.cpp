// The proxy's way along a step: free as far as it goes, and no farther than the first thing that is no contact.
#include "proxy/walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "judge.h"

namespace hl::test_walk {
namespace {

constexpr double kRadius = 1e-3;

// A wall at x = 0.1 that looks to -x.
std::shared_ptr<const Snapshot> wall() {
  return judge::scene(judge::triangles({{Vec3(0.1, -1, -1), Vec3(0.1, 1, -1), Vec3(0.1, 0, 1)}}));
}

class WalkTest : public testing::Test {
 protected:
  // Goes from `position` by `step`, in the open; whether it has gone the whole way.
  bool go(const Vec3& step, Vec3& position) {
    const TickInput input(scene_, settings_, position + step);
    Walk walk(input, cache_);
    ContactSet set;
    gatherContacts(scene_, position, input.tolerance.touching, input.tolerance.reach, set);
    return walk.go(set, Walk::Along::kAir, step, position) == Walk::Made::kWhole;
  }
  // In as many legs as it takes, by one Walk, as in a tick; returns how many.
  int legsTo(const Vec3& goal, Vec3& position, bool& whole) {
    const TickInput input(scene_, settings_, goal);
    Walk walk(input, cache_);
    ContactSet set;
    whole = false;
    for (int legs = 0;; ++legs) {
      gatherContacts(scene_, position, input.tolerance.touching, input.tolerance.reach, set);
      if (whole || !set.contacts.empty()) return legs;
      whole = walk.go(set, Walk::Along::kAir, goal - position, position) == Walk::Made::kWhole;
    }
  }
  bool fly(const Vec3& finger, Vec3& position) {
    const TickInput input(scene_, settings_, finger);
    Walk walk(input, cache_);
    ContactSet set;
    gatherContacts(scene_, position, input.tolerance.touching, input.tolerance.reach, set);
    walk.fly(set, position);
    return position == finger;
  }

  std::shared_ptr<const Snapshot> snapshot_ = wall();
  SceneAt scene_{*snapshot_};
  ProxySettings settings_{};
  ProxyCache cache_;
};

TEST_F(WalkTest, FreeItGoesTheWholeWayToTheBit) {
  Vec3 position(0, 0, 0);
  EXPECT_TRUE(go({0.001, 0.002, 0.003}, position));
  EXPECT_EQ(position, Vec3(0.001, 0.002, 0.003));
}

TEST_F(WalkTest, ALongWayIsGoneInLegsEachTwiceAsLong) {
  Vec3 position(0, 0, 0);
  bool whole = false;
  EXPECT_EQ(legsTo({-1, 0, 0}, position, whole), 7) << "8, 16, 32, ... up to 1000 reaches";
  EXPECT_TRUE(whole);
  EXPECT_NEAR(position.x(), -1, 1e-15);
  EXPECT_EQ(legsTo({1, 0, 0}, position, whole), 8) << "to the wall";
  EXPECT_FALSE(whole);
  EXPECT_NEAR(position.x(), 0.1 - kRadius, 1e-9);
}

TEST_F(WalkTest, ItStopsAtTheFirstImpactARadiusAway) {
  Vec3 position(0.095, 0, 0);
  EXPECT_FALSE(go({1, 0, 0}, position));
  EXPECT_NEAR(position.x(), 0.1 - kRadius, 1e-9);
  EXPECT_EQ(position.y(), 0);
}

TEST_F(WalkTest, AContactIsHeldOffByItsPlaneAndNotSwept) {
  Vec3 position(0.095, 0, 0);
  EXPECT_FALSE(go({1, 0, 0}, position));
  const double x = position.x();
  EXPECT_TRUE(go({0, 0.005, 0}, position)) << "along the wall";
  EXPECT_EQ(position.x(), x);
  EXPECT_NEAR(position.y(), 0.005, 1e-15);
}

TEST_F(WalkTest, AStepFarBeyondTheSceneIsCutAndNotWhole) {
  Vec3 position(0, 0, 0);
  EXPECT_FALSE(go({-1e9, 0, 0}, position));
  EXPECT_NEAR(position.x(), -convergence::kFirstLegPerReach * kRadius, 1e-9);
}

TEST_F(WalkTest, InTheOpenTheProxyIsTheFingerToTheBit) {
  Vec3 position(0, 0, 0);
  while (!fly({0.1 - 0.1 / 3, 1.0 / 7, 1.0 / 11}, position)) ASSERT_TRUE(position.allFinite());
  while (!fly({-1e12, 1.0 / 7, 0}, position)) ASSERT_TRUE(position.allFinite());
  while (!fly({-1.0 / 3, 0, 0}, position)) ASSERT_TRUE(position.allFinite());
  EXPECT_FALSE(fly({1, 0, 0}, position)) << "behind the wall";
}

// The same way in many small steps and with a cache that has been forgotten ends at the same place.
TEST_F(WalkTest, WhatIsKnownDecidesNothing) {
  Vec3 with(0.0985, 0, 0), without = with;
  for (int i = 0; i < 50; ++i) {
    const Vec3 step(2e-5, 1e-5 * std::sin(i), 0);
    const bool whole = go(step, with);
    cache_ = {};
    EXPECT_EQ(go(step, without), whole);
    EXPECT_EQ(with, without) << i;
  }
}

}  // namespace
}  // namespace hl::test_walk
