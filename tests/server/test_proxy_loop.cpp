// The proxy loop on a virtual clock: scenes that appear, change and go under the finger.
#include "server/proxy_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/realtime_guard.h"
#include "scene/editable_scene.h"

namespace hl {
namespace {

constexpr double kSpring_N_m = 1000;
constexpr std::int64_t kMs = 1'000'000;

std::shared_ptr<const Shape> floorShape() {
  Model model;
  model.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  model.triangles = {{0, 1, 2}, {0, 2, 3}};
  return makeShape(std::move(model), HierarchyKind::kBvh);
}

Instance floorAt(double y, std::uint64_t key = 5) {
  Instance instance;
  instance.shape = floorShape();
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion({Mat3::Identity(), {0, y, 0}});
  instance.key = key;
  instance.object = 3;
  instance.name = 9;
  instance.session = 2;
  return instance;
}

// A loop at 1 kHz with a finger that is held still, and the spring's force on it as the servo makes it.
class Bench {
 public:
  explicit Bench(std::vector<Instance> first)
      : slot_(makeSnapshot(std::move(first), "", number_)), loop_(slot_, ProxySettings{}) {
    commands_.radius_W = 0.002;
  }

  void publish(std::vector<Instance> instances, std::int64_t blend_ns = kAbruptBlend_ns) {
    ASSERT_TRUE(slot_.taken());
    slot_.publish(makeSnapshot(std::move(instances), "", ++number_, blend_ns));
  }
  // The largest change of force between two steps, in N.
  double run(int steps, const Vec3& finger) {
    double most = 0;
    for (int i = 0; i < steps; ++i) {
      time_ns_ += kMs;
      const ProxyStep step = loop_.step(time_ns_, finger, commands_, {kSpring_N_m, LedgerMode::kTank, 1e-3});
      const ServoTarget& target = step.held.target;
      const Vec3 force =
          target.valid ? Vec3(kSpring_N_m * target.stiffness * (target.proxy_D - finger)) : Vec3(Vec3::Zero());
      most = std::max(most, (force - force_).norm());
      force_ = force;
      last_ = step;
    }
    return most;
  }

  std::uint64_t number_ = 1;
  SnapshotSlot slot_;
  ProxyLoop loop_;
  ProxyCommands commands_;
  std::int64_t time_ns_ = 0;
  Vec3 force_ = Vec3::Zero();
  ProxyStep last_;
};

// 5 mm deep at 1000 N/m are 7 N; let go within 60 ms that is 0.12 N a step.
constexpr double kGentle_N = 0.15;

TEST(ProxyLoop, AnObjectThatGoesLetsTheForceFadeOut) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.005, 0});
  EXPECT_NEAR(bench.force_.y(), 7, 1e-6);
  bench.publish({});
  EXPECT_LT(bench.run(100, {0, -0.005, 0}), kGentle_N);
  EXPECT_EQ(bench.force_, Vec3::Zero());
  EXPECT_FALSE(bench.last_.held.target.valid);
}

TEST(ProxyLoop, AnObjectThatAppearsAroundTheFingerPushesWithoutAJump) {
  Bench bench({});
  bench.run(10, {0, 0.0005, 0});
  bench.publish({floorAt(0)});
  EXPECT_LT(bench.run(100, {0, 0.0005, 0}), kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 1.5, 1e-6) << "the sphere of 2 mm rests on it";
}

TEST(ProxyLoop, AnObjectOverwrittenUnderTheFingerChangesTheForceWithoutAJump) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  bench.publish({floorAt(0.0015)});
  EXPECT_LT(bench.run(200, {0, -0.003, 0}), kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 6.5, 1e-6);
}

TEST(ProxyLoop, AMovingObjectIsFollowedAtOnce) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  Instance moving = floorAt(0);
  moving.motion =
      moving.motion.then({Mat3::Identity(), {0, 0.002, 0}}, bench.time_ns_ + kMs, bench.time_ns_ + 11 * kMs);
  bench.publish({moving}, 0);
  bench.run(12, {0, -0.003, 0});
  EXPECT_NEAR(bench.force_.y(), 7, 1e-6);
}

// The floor `up` higher, as its client bent it.
Instance bentFloor(const Instance& before, double up) {
  Model model = before.shape->model;
  for (Vec3& p : model.positions) p.y() += up;
  Instance now = before;
  now.before = before.shape;
  now.shape = makeShape(std::move(model), *before.shape);
  return now;
}

// 1 mm up each frame of 20 ms.
TEST(ProxyLoop, AMeshThatBendsIsFollowedFromFrameToFrame) {
  Instance skin = floorAt(0);
  Bench bench({skin});
  bench.run(100, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  for (int frame = 1; frame <= 4; ++frame) {
    skin = bentFloor(skin, 0.001);
    bench.publish({skin}, 20 * kMs);
    EXPECT_NEAR(bench.run(20, {0, -0.003, 0}), 0.05, 1e-6) << "as much in every step";
    EXPECT_NEAR(bench.force_.y(), 5 + frame, 1e-6) << "there when the next frame comes";
  }
}

TEST(ProxyLoop, WhatBendsBesideWhatAppearsHurriesNothing) {
  Instance skin = floorAt(-0.1);
  Bench bench({skin});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, 0.0005, 0});
  bench.publish({skin, floorAt(0, 7)});
  double most = bench.run(10, {0, 0.0005, 0});
  for (int frame = 0; frame < 10; ++frame) {
    skin = bentFloor(skin, 0.001);
    bench.publish({skin, floorAt(0, 7)}, 8 * kMs);
    most = std::max(most, bench.run(8, {0, 0.0005, 0}));
  }
  EXPECT_LT(most, kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 1.5, 1e-6);
}

TEST(ProxyLoop, TellsWhatIsTouchedByTheNamesOfItsClient) {
  Bench bench({floorAt(0)});
  bench.run(5, {0, 0.01, 0});
  bench.run(5, {0, -0.001, 0});
  ASSERT_EQ(bench.last_.touched.size(), 1u);
  EXPECT_EQ(bench.last_.touched[0].object, 3u);
  bench.run(30, {0, 0.01, 0});
  TouchEvent event;
  ASSERT_TRUE(bench.loop_.popEvent(event));
  EXPECT_TRUE(event.touches);
  EXPECT_EQ(event.object.name, 9u);
  EXPECT_EQ(event.object.session, 2u);
  EXPECT_EQ(event.time_ns, 6 * kMs);
  ASSERT_TRUE(bench.loop_.popEvent(event));
  EXPECT_FALSE(event.touches);
  EXPECT_FALSE(bench.loop_.popEvent(event));
}

TEST(ProxyLoop, AnotherWorkspaceStartsTheProxyAnewWithoutAJump) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.005, 0});
  bench.commands_.workspace = {{0, 0.5, 0}, 10};
  ++bench.commands_.restarts;
  EXPECT_LT(bench.run(100, {0, -0.005, 0}), kGentle_N);
  EXPECT_EQ(bench.force_, Vec3::Zero()) << "0.45 m above the floor";
}

TEST(ProxyLoop, AllocatesNothing) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.publish({floorAt(0.001), floorAt(-1, 6)});
  const RealtimeGuard guard;
  bench.run(100, {0, -0.005, 0});
}

}  // namespace
}  // namespace hl
