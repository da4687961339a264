// The budget of one tick: what is used up ends it at a valid place, and all ticks together come to the same end.
#include "proxy/work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_work {
namespace {

constexpr double kRadius = 1e-3;

TEST(Work, ATickMayEndOnceItsWorkIsUsedUpAndItHasMadeAStep) {
  const ContactSet nothing;
  const auto snapshot = judge::scene(Model{});
  const SceneAt scene(*snapshot);
  Work work(scene, 2 * convergence::kWorkPerLook, kNoWorkCap);
  work.stepped();
  work.looked(nothing);
  EXPECT_FALSE(work.usedUp());
  work.looked(nothing);
  EXPECT_TRUE(work.usedUp());
  EXPECT_TRUE(work.ends());

  Work without_step(scene, 0, kNoWorkCap);
  without_step.looked(nothing);
  EXPECT_TRUE(without_step.usedUp());
  EXPECT_FALSE(without_step.ends());
}

TEST(Work, WhatTheSceneIsAskedIsCounted) {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.triangles = {{0, 1, 2}};
  const auto snapshot = judge::scene(model);
  const SceneAt scene(*snapshot);
  const Work work(scene, 1000, kNoWorkCap);
  EXPECT_EQ(work.done(), 0u);
  scene.primitivesWithin({0.1, 0.1, 0.1}, 0.2, [](PrimitiveId, const ClosestPoint&) {});
  EXPECT_EQ(scene.cost().volumes, 8u);  // one block of up to eight triangles
  EXPECT_EQ(scene.cost().primitives, 1u);
  EXPECT_EQ(work.done(), 8u + convergence::kWorkPerPrimitive);
  SceneImpact impact;
  EXPECT_TRUE(scene.firstImpact({0.1, 0.1, 1}, {0, 0, -2}, 0.01, -1, impact));
  EXPECT_GT(scene.cost().volumes, 8u);
  EXPECT_GT(scene.cost().primitives, 1u);
}

// A cone of so many sides about +z, its apex at the origin.
Model cone(std::uint32_t sides, double height = 0.02) {
  Model model;
  model.positions.push_back(Vec3::Zero());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    model.positions.emplace_back(0.02 * std::cos(angle), 0.02 * std::sin(angle), -height);
    model.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  return model;
}

struct Arrival {
  Vec3 place;
  int ticks = 0, out_of_work = 0;
};

// By another hierarchy, which does other work.
TEST(Work, ATickIsMadeAgainByItsLooks) {
  const auto scene = judge::scene(cone(200)), other = judge::scene(cone(200), HierarchyKind::kNone);
  ProxySettings settings, any;
  any.work_cap = kNoWorkCap;
  ProxyState state = startProxy(*scene, settings, {0, 0, 2e-3}), again = state;
  int used_up = 0;
  for (int i = 0; i < 300; ++i) {
    const double angle = 0.37 * i, out = 2e-3 * std::exp(-0.05 * i);
    const Vec3 finger(out * std::cos(angle), out * std::sin(angle), -1e-3 * (1 + i % 5));
    const TickReport report = tick(state, *scene, settings, finger);
    used_up += report.used_up_at > 0 ? 1 : 0;
    const int looks = report.used_up_at > 0 ? report.used_up_at : kNoWorkCap;
    const TickReport same = tick(again, *other, any, finger, looks);
    ASSERT_EQ(state.position, again.position) << i;
    ASSERT_EQ(report.iterations, same.iterations) << i;
    ASSERT_EQ(report.ending, same.ending) << i;
  }
  EXPECT_GT(used_up, 10);
}

// With a finger that rests there, until a tick ends otherwise.
Arrival rest(const Snapshot& scene, ProxyState state, const Vec3& finger, int work_cap) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.work_cap = work_cap;
  ManyRecentPrimitives recent;
  Arrival arrival;
  double before = (state.position - finger).norm();
  while (arrival.ticks < 2000) {
    const TickReport report = tick(state, {scene, 0, recent}, settings, finger);
    ++arrival.ticks;
    EXPECT_GE(judge::clearance(scene, state.position, 2 * kRadius), kRadius * (1 - 1e-12));
    const double now = (state.position - finger).norm();
    EXPECT_LE(now, before * (1 + 1e-12));
    EXPECT_LE(report.injected_J, 1e-15);
    before = now;
    if (report.ending != Ending::kOutOfWork) break;
    ++arrival.out_of_work;
  }
  arrival.place = state.position;
  return arrival;
}

TEST(Work, ARestingFingerBringsTheProxyToTheSamePlaceWithAnyBudget) {
  const auto scene = judge::scene(cone(60));
  const ProxySettings settings;
  for (const Vec3& finger : {Vec3(3e-3, 2e-3, -6e-3), Vec3(1e-3, 4e-3, -5e-3), Vec3(-2e-3, 1e-3, -4e-3)}) {
    const ProxyState start = startProxy(*scene, settings, {0, 0, 2e-3});
    const Arrival all = rest(*scene, start, finger, 1'000'000);
    const Arrival some = rest(*scene, start, finger, 3000), least = rest(*scene, start, finger, 1);
    EXPECT_EQ(all.out_of_work, 0);
    EXPECT_GT(least.out_of_work, some.out_of_work);
    EXPECT_NEAR((some.place - all.place).norm(), 0, 1e-6 * kRadius);
    EXPECT_NEAR((least.place - all.place).norm(), 0, 1e-6 * kRadius);
  }
}

// Drawn at random: a finger some micrometres from the vertex, where the directions in which the proxy may rest differ
// least, came to no end there.
TEST(Work, AFingerAtAVertexOfHundredsOfSidesBringsTheProxyToItsPlaceWithTheUsualBudget) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> spread(-1, 1), decade(-4, -2), slope(-2, 0.7);
  for (int i = 0; i < 60; ++i) {
    const double above = i % 2 == 0 ? 1 : -1;  // a tip, or from inside a pit's other side
    const auto scene = judge::scene(cone(i % 3 == 0 ? 1000 : 300, above * 0.02 * std::pow(10, slope(random))));
    const Vec3 finger = kRadius * std::pow(10, decade(random)) * Vec3(spread(random), spread(random), spread(random));
    const Vec3 from = kRadius * Vec3(2 * spread(random), 2 * spread(random), 3 * above);
    const ProxyState start = startProxy(*scene, ProxySettings{}, from);
    const Arrival all = rest(*scene, start, finger, kNoWorkCap);
    const Arrival usual = rest(*scene, start, finger, ProxySettings{}.work_cap);
    EXPECT_LT(usual.ticks, 200) << i;
    EXPECT_NEAR((usual.place - all.place).norm(), 0, 1e-6 * kRadius) << i;
  }
}

TEST(Work, WithTheUsualBudgetNoTickAtAnApexOfAThousandSidesReachesTheIterationCap) {
  const auto scene = judge::scene(cone(1000));
  ProxySettings settings;
  ManyRecentPrimitives recent;
  ProxyState state = startProxy(*scene, settings, {0, 0, 2e-3});
  for (int i = 0; i < 300; ++i) {
    const double angle = 0.37 * i, out = 2e-3 * std::exp(-0.05 * i);
    const Vec3 finger(out * std::cos(angle), out * std::sin(angle), -1e-3 * (1 + i % 5));
    const TickReport report = tick(state, {*scene, 0, recent}, settings, finger);
    ASSERT_FALSE(report.ending == Ending::kCapped) << i;
    ASSERT_GE(judge::clearance(*scene, state.position, 2 * kRadius), kRadius * (1 - 1e-12)) << i;
  }
}

}  // namespace
}  // namespace hl::test_work
