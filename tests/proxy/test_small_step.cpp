// How far time may go on while meshes bend or objects close in: never so far that anything could cross the centre.
#include "proxy/small_step.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "geometry/scenes.h"
#include "judge.h"
#include "moving_scenes.h"

namespace hl::test_small_step {
namespace {

constexpr double kRadius = 0.002;
constexpr std::int64_t kMs = 1'000'000;
constexpr int kManyLeft = 1'000'000;

PushedProxy proxyIn(const SceneAt& at_end, const Vec3& position) {
  return {at_end, Tolerances::of(kRadius, at_end.extent()), 0, position, kNoInstance};
}

std::shared_ptr<const Snapshot> rising(double to) {
  return makeSnapshot({test::deforming(1, test::flatSheet(0), test::flatSheet(to), 0, 10 * kMs)});
}

TEST(SmallStep, AMeshBendsNearWhereItsReachDoesWhileItBends) {
  const auto scene = rising(0.01);
  EXPECT_TRUE(deformsNear(proxyIn({*scene, 10 * kMs}, {0, 0.01 + 1.9 * kRadius, 0})));
  EXPECT_FALSE(deformsNear(proxyIn({*scene, 10 * kMs}, {0, 0.01 + 2.1 * kRadius, 0}))) << "beyond all its places";
  const SceneAt at_end(*scene, 20 * kMs);
  PushedProxy later = proxyIn(at_end, {0, 0.01, 0});
  later.now_ns = 10 * kMs;
  EXPECT_FALSE(deformsNear(later)) << "it has come to rest";
  EXPECT_FALSE(
      deformsNear(proxyIn({*makeSnapshot({test::place(1, test::flatSheet(0), Motion())}), 10 * kMs}, {0, 0, 0})));
}

TEST(SmallStep, AMeshTakesHalfOfTheRoomAndNoLess) {
  for (const double to : {0.005, 0.01, 0.1}) {
    const auto scene = rising(to);
    const Advance free = smallStep(proxyIn({*scene, 10 * kMs}, {0.001, kRadius, 0.002}), kManyLeft);
    const double height = to * static_cast<double>(free.until_ns) / 10e6;
    EXPECT_NEAR(height, convergence::kCloseIn * kRadius, 1e-7) << to;
  }
}

TEST(SmallStep, WhatStaysFarEnoughIsGoneAtOnce) {
  EXPECT_EQ(smallStep(proxyIn({*rising(0.4 * kRadius), 10 * kMs}, {0.001, kRadius, 0.002}), kManyLeft).until_ns,
            10 * kMs);
}

TEST(SmallStep, OfTheStepsLeftEachTakesItsShare) {
  const auto scene = rising(10);
  for (const int left : {1, 2, 5})
    EXPECT_EQ(smallStep(proxyIn({*scene, 10 * kMs}, {0.001, kRadius, 0.002}), left).until_ns, 10 * kMs / left);
}

TEST(SmallStep, ObjectsThatMoveTakeNoMoreThanHalfOfTheRoom) {
  const Model plate = test::rectangle({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1});
  const Motion up = Motion(test::at({0, -kRadius, 0})).then(test::at({0, 0.1, 0}), 0, 10 * kMs);
  const auto scene = makeSnapshot({test::place(1, plate, up)});
  const double height = up.at(smallStep(proxyIn({*scene, 10 * kMs}, Vec3::Zero()), kManyLeft).until_ns).origin.y();
  EXPECT_LE(height, -(1 - convergence::kCloseIn) * kRadius);
  EXPECT_GE(height, -(1 - 0.8 * convergence::kCloseIn) * kRadius) << "nor much less";
}

TEST(SmallStep, ItEndsWhereAMeshTakesAnotherWay) {
  Instance skin = test::deforming(1, test::flatSheet(0), test::flatSheet(1e-4), 0, 4 * kMs);
  const auto next = makeShape(test::flatSheet(0), *skin.shape);
  skin.mesh_motion = std::make_shared<MeshMotion>(skin.mesh_motion->then(next, 2 * kMs, 9 * kMs));
  skin.shape = next;
  const auto scene = makeSnapshot({skin});
  EXPECT_EQ(smallStep(proxyIn({*scene, 10 * kMs}, {0, kRadius, 0}), kManyLeft).until_ns,
            scene->instances[0].mesh_motion->last().begin_ns());
}

// Any wave into any other: at each moment until the end of the step the centre keeps half of its room, or half a
// radius.
RC_GTEST_PROP(SmallStep, TheCentreKeepsHalfOfItsRoomAllTheWay, (std::uint64_t seed)) {
  test::Random random(seed);
  const auto wave = [&] {
    const double size = random.uniform(0, 0.02), k = random.uniform(0, 120), phase = random.uniform(0, 6);
    const Vec3 aside = random.inCube(0.02);
    Model model = test::sheet([&](double x, double z) { return size * std::sin(k * x + phase) * std::cos(k * z); }, 16);
    for (Vec3& p : model.positions) p += aside;
    return model;
  };
  const auto scene = makeSnapshot({test::deforming(1, wave(), wave(), 0, 10 * kMs)});
  const Vec3 place = random.inCube(0.02);
  const double room = judge::clearance({*scene, 0}, place, kRadius);
  RC_PRE(room > 0.01 * kRadius);
  const Advance free = smallStep(proxyIn({*scene, 10 * kMs}, place), kManyLeft);
  RC_ASSERT(free.until_ns > 0);
  for (int i = 1; i <= 40; ++i) {
    const double then = judge::clearance({*scene, free.until_ns * i / 40}, place, kRadius);
    RC_ASSERT(then >= (1 - convergence::kCloseIn) * room * (1 - 1e-6));
  }
}

}  // namespace
}  // namespace hl::test_small_step
