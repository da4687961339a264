// Objects that something else than their client drives.
#include "scene/pose_source.h"

#include <gtest/gtest.h>

#include "geometry/scenes.h"
#include "judge.h"
#include "moving_scenes.h"
#include "proxy/proxy.h"
#include "scripted_poses.h"

namespace hl::test_pose_source {
namespace {

constexpr double kRadius = 0.002;
constexpr std::int64_t kMs = 1'000'000;

ProxySettings settingsOf(double friction) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.surfaces.static_friction = settings.surfaces.dynamic_friction = friction;
  return settings;
}

Pose randomPose(test::Random& random, double turn_rad, double slide_m) {
  return {Eigen::AngleAxisd(turn_rad * random.uniform(0, 1), random.direction()).toRotationMatrix(),
          slide_m * random.inCube(1)};
}

std::shared_ptr<const Snapshot> drivenBox(std::shared_ptr<const PoseSource> driver, const Motion& motion = Motion()) {
  Instance box = test::place(1, test::boxModel({0.01, 0.01, 0.01}), motion);
  box.driver = std::move(driver);
  return makeSnapshot({std::move(box)});
}

TEST(PoseSource, AScriptOfTwoPosesIsTheMotionOfAClientBitByBit) {
  test::Random random(1);
  for (int i = 0; i < 60; ++i) {
    const Pose from = randomPose(random, 1, 0.02), to = randomPose(random, 2.5, 0.03);
    const Motion motion(Screw(from), Screw(from, to, 2 * kMs, 22 * kMs));
    const auto script =
        std::make_shared<test::ScriptedPoses>(test::ScriptedPoses::Script{{2 * kMs, from}, {22 * kMs, to}});
    const auto driven = drivenBox(script), moved = drivenBox(nullptr, motion);
    ASSERT_TRUE(driven->reach[0].min == moved->reach[0].min && driven->reach[0].max == moved->reach[0].max);
    ASSERT_EQ(driven->moves_until_ns, moved->moves_until_ns);
    const ProxySettings settings = settingsOf(0.3 * (i % 3));
    const Vec3 finger = random.inCube(0.015);
    ProxyState a = startProxy({*driven, 0}, settings, finger), b = startProxy({*moved, 0}, settings, finger);
    for (std::int64_t t = kMs; t < 25 * kMs; t += kMs) {
      tick(a, {*driven, t}, settings, finger);
      tick(b, {*moved, t}, settings, finger);
      ASSERT_EQ(a.position, b.position) << i << ", " << t;
    }
  }
}

// Twists and turns that no motion of a client has: six poses in 40 ms.
TEST(PoseSource, WhatAScriptDrivesNeverPassesTheProxy) {
  test::Random random(2);
  int pushed = 0;
  for (int i = 0; i < 200; ++i) {
    test::ScriptedPoses::Script script;
    for (int k = 0; k < 6; ++k) script.emplace_back(8 * k * kMs + (k > 0 ? i % 7 : 0), randomPose(random, 3, 0.02));
    const auto scene = drivenBox(std::make_shared<test::ScriptedPoses>(script));
    const ProxySettings settings = settingsOf(0.4 * (i % 2));
    const Vec3 finger = random.inCube(0.02);
    ProxyState state = startProxy({*scene, 0}, settings, finger);
    if (!state.free) continue;
    // Outside of the box in the beginning, and so at all times.
    const auto outside = [&](std::int64_t t) {
      const Vec3 own = scene->instances[0].poses().at(t).toObject(state.position);
      const Vec3 beyond = (own.cwiseAbs() - Vec3::Constant(0.01)).cwiseMax(0);
      return beyond.norm();
    };
    if (outside(0) < kRadius) continue;  // it began within
    for (std::int64_t t = kMs; t < 45 * kMs; t += kMs) {
      tick(state, {*scene, t}, settings, finger);
      ASSERT_GE(outside(t), kRadius * (1 - 1e-9)) << i << ", " << t;
    }
    pushed += (state.position - finger).norm() > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(pushed, 20);
}

}  // namespace
}  // namespace hl::test_pose_source
