// The proxy's way along a step: free as far as it goes, and no farther than the first thing that is no contact.
#include "proxy/walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "judge.h"

namespace hl {
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
    return walk.go(set, false, step, position);
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
  EXPECT_TRUE(go({0.01, 0.02, 0.03}, position));
  EXPECT_EQ(position, Vec3(0.01, 0.02, 0.03));
}

TEST_F(WalkTest, ItStopsAtTheFirstImpactARadiusAway) {
  Vec3 position(0, 0, 0);
  EXPECT_FALSE(go({1, 0, 0}, position));
  EXPECT_NEAR(position.x(), 0.1 - kRadius, 1e-9);
  EXPECT_EQ(position.y(), 0);
}

TEST_F(WalkTest, AContactIsHeldOffByItsPlaneAndNotSwept) {
  Vec3 position(0, 0, 0);
  EXPECT_FALSE(go({1, 0, 0}, position));
  const double x = position.x();
  EXPECT_TRUE(go({0, 0.01, 0}, position)) << "along the wall";
  EXPECT_EQ(position.x(), x);
  EXPECT_NEAR(position.y(), 0.01, 1e-15);
}

TEST_F(WalkTest, AStepFarBeyondTheSceneIsCutAndNotWhole) {
  Vec3 position(0, 0, 0);
  EXPECT_FALSE(go({-1e9, 0, 0}, position));
  EXPECT_LT(position.x(), -1);
  EXPECT_GT(position.x(), -1e3);
}

TEST_F(WalkTest, InTheOpenTheProxyIsTheFingerToTheBit) {
  Vec3 position(0, 0, 0);
  EXPECT_TRUE(fly({0.1 - 0.1 / 3, 1.0 / 7, 1.0 / 11}, position));
  EXPECT_TRUE(fly({-1e12, 1.0 / 7, 0}, position)) << "however far";
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
}  // namespace hl
