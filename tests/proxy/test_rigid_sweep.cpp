// How far time may go on while objects move on screws: to the moment when one meets the proxy, by formula and by
// looking at many moments before.
#include "proxy/rigid_sweep.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/scenes.h"
#include "moving_scenes.h"

namespace hl::test_rigid_sweep {
namespace {

constexpr double kRadius = 0.002;
constexpr std::int64_t kMs = 1'000'000;

Advance sweepIn(const Snapshot& scene, const Vec3& position, std::int64_t end_ns, std::uint32_t carrier = kNoInstance) {
  return rigidSweep({{scene, end_ns}, Tolerances::of(kRadius, scene.extent), 0, position, carrier});
}

Model plate() { return test::rectangle({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1}); }

TEST(RigidSweep, APlateMeetsTheProxyWhereTheFormulaSays) {
  for (const double speed : {0.1, 1.0, 100.0}) {
    const auto way_ns = static_cast<std::int64_t>(0.05 / speed * 1e9);
    const Motion motion = Motion(test::at({0, -0.02, 0})).then(test::at({0, 0.03, 0}), 0, way_ns);
    const auto scene = makeSnapshot({test::place(1, plate(), motion)});
    const Advance free = sweepIn(*scene, Vec3::Zero(), way_ns);
    EXPECT_EQ(free.met, 0u);
    const double height = motion.at(free.until_ns).origin.y();
    EXPECT_NEAR(height, -accuracy::kMetAt * kRadius, 1e-8 + 1e-9 * speed) << speed;
    EXPECT_LE(height, -accuracy::kMetAt * kRadius + 1e-8);
  }
}

TEST(RigidSweep, WhereNothingMeetsItTimeGoesOnToTheTick) {
  const Motion away = Motion(test::at({0, -0.01, 0})).then(test::at({0, -0.1, 0}), 0, 100 * kMs);
  const auto scene = makeSnapshot({test::place(1, plate(), away), test::place(2, plate(), Motion())});
  const Advance free = sweepIn(*scene, {0, 0.5 * kRadius, 0}, 10 * kMs);
  EXPECT_EQ(free.until_ns, 10 * kMs);
  EXPECT_EQ(free.met, kNoInstance) << "what rests does not meet a proxy that stands still";
}

TEST(RigidSweep, WhatTurnsGoesNoFartherThanAStraightWayIsTrue) {
  const Motion turning = Motion().then(test::turned(1, Vec3::UnitZ()), 0, 10 * kMs);
  const auto scene = makeSnapshot({test::place(1, plate(), turning)});
  const Advance free = sweepIn(*scene, {0, 0.3, 0}, 10 * kMs);
  EXPECT_NEAR(static_cast<double>(free.until_ns), accuracy::kMaxTurn_rad * 10e6, 2);
}

TEST(RigidSweep, ItEndsWhereAnObjectTakesAnotherScrew) {
  const Motion motion =
      Motion(test::at({0, -1e-2, 0})).then(test::at({0, -2e-2, 0}), 0, 9 * kMs).then(test::at({}), 4 * kMs, 9 * kMs);
  const auto scene = makeSnapshot({test::place(1, plate(), motion)});
  EXPECT_EQ(sweepIn(*scene, {0, 0.001, 0}, 9 * kMs).until_ns, 4 * kMs);
}

TEST(RigidSweep, ACarrierDoesNotMeetItsProxyButWhatRestsDoes) {
  const Motion along = Motion().then(test::at({0.1, 0, 0}), 0, 10 * kMs);
  const Model wall = test::rectangle({0.05, -0.1, 0.1}, {0, 0, -0.2}, {0, 0.2, 0});
  const auto scene = makeSnapshot({test::place(1, plate(), along), test::place(2, wall, Motion())});
  const Advance free = sweepIn(*scene, {0, 0.5 * kRadius, 0}, 10 * kMs, 0);
  EXPECT_EQ(free.met, 1u);
  EXPECT_NEAR(static_cast<double>(free.until_ns), (0.05 - accuracy::kMetAt * kRadius) / 0.1 * 10e6, 10);
}

TEST(RigidSweep, NoScrewMakesACarrierMeetItsProxy) {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose end{Eigen::AngleAxisd(random.uniform(0, 0.1), random.direction()).toRotationMatrix(),
                   random.inCube(0.1)};
    const Motion motion = Motion().then(end, 0, 10 * kMs);
    const auto scene = makeSnapshot({test::place(1, plate(), motion)});
    const Vec3 place(random.uniform(-0.1, 0.1), random.uniform(0.1, 0.8) * kRadius, random.uniform(-0.1, 0.1));
    const Advance free = sweepIn(*scene, place, 10 * kMs, 0);
    ASSERT_EQ(free.met, kNoInstance) << i;
    ASSERT_EQ(free.until_ns, 10 * kMs);
  }
}

double distanceAt(const Instance& instance, const Vec3& p, std::int64_t time_ns) {
  const Vec3 own = instance.motion.at(time_ns).toObject(p);
  double least = 1;
  const Primitives& all = instance.shape->primitives;
  for (std::uint32_t i = 0; i < all.size(); ++i) least = std::min(least, closestPoint(all[i], own).distance);
  return least;
}

// Boxes that tumble by at most half a circle: at each moment until the end of the sweep they are as far as they may be.
// By the straight way they may come nearer by 1/200 of the distance from the axis.
RC_GTEST_PROP(RigidSweep, NothingComesNearerBeforeItsEnd, (std::uint64_t seed)) {
  test::Random random(seed);
  std::vector<Instance> boxes;
  for (std::uint64_t key = 1; key <= 3; ++key) {
    const auto pose = [&] {
      return Pose{Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix(), random.inCube(0.04)};
    };
    const Motion motion = Motion(pose()).then(pose(), 0, (5 + random.below(50)) * kMs);
    boxes.push_back(test::place(key, test::boxModel({0.01, 0.02, 0.015}), motion));
  }
  const auto scene = makeSnapshot(boxes);
  const Vec3 place = random.inCube(0.05);
  for (const Instance& box : scene->instances) RC_PRE(distanceAt(box, place, 0) > kRadius);
  const Advance free = sweepIn(*scene, place, 40 * kMs);
  const double least = accuracy::kMetAt * kRadius - 0.1 / 200;
  for (int i = 0; i <= 50; ++i) {
    const std::int64_t time_ns = free.until_ns * i / 50;
    for (const Instance& box : scene->instances) RC_ASSERT(distanceAt(box, place, time_ns) >= least);
  }
  if (free.met == kNoInstance) return;
  const double met = distanceAt(scene->instances[free.met], place, free.until_ns);
  RC_ASSERT(std::abs(met - accuracy::kMetAt * kRadius) <= 0.1 / 200);
}

}  // namespace
}  // namespace hl::test_rigid_sweep
