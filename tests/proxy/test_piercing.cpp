// Piercing: a surface lets the proxy through when it is pressed harder than its strength.
#include "proxy/piercing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <random>
#include <utility>
#include <vector>

#include "cases.h"
#include "effect_scenes.h"
#include "guard/realtime_guard.h"
#include "moving_scenes.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_piercing {
namespace {

constexpr double kK = 1000;
constexpr double kRadius = 0.001;
constexpr double kRounding_m = 1e-12;

ProxySettings piercing(double strength_N) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.surfaces.strength_N = strength_N;
  return settings;
}

void pressTo(ProxyState& state, const Snapshot& scene, const ProxySettings& settings, const Vec3& from, const Vec3& to,
             int ticks) {
  for (int i = 1; i <= ticks; ++i) tick(state, scene, settings, from + (i / static_cast<double>(ticks)) * (to - from));
}

// The closed form: the spring presses with K d until K d = F; 1/2 K d^2 = 2.0 mJ is lost then.
TEST(Piercing, TwoNewtonLetGoAtTwoMillimetresAndTwoMillijouleAreLost) {
  const auto scene = test::snapshotOf(test::floorModel());
  const ProxySettings settings = piercing(2);
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  const Vec3 top(0, kRadius, 0), deepest = top - Vec3(0, 1.9999e-3, 0);
  pressTo(state, *scene, settings, {0, 0.01, 0}, top, 10);
  pressTo(state, *scene, settings, top, deepest, 2000);
  EXPECT_NEAR(state.position.y(), kRadius, kRounding_m);
  const double before_J = state.ledger.dissipated_J;
  const Vec3 deeper = top - Vec3(0, 2.0001e-3, 0);
  tick(state, *scene, settings, deeper);  // is felt, and then let go
  EXPECT_EQ(state.pierced.size(), 1U);
  const TickReport report = tick(state, *scene, settings, deeper);
  EXPECT_EQ(report.contacts.size(), 0U);
  EXPECT_NEAR((state.position - deeper).norm(), 0, kRounding_m);
  EXPECT_NEAR(state.ledger.dissipated_J - before_J, 2.0e-3, 1e-6);
  EXPECT_EQ(state.ledger.injected_J, 0);
}

// What moves pushes the proxy between two ticks; what it has pierced does not, wherever else something moves.
TEST(Piercing, WhatMovesElsewhereChangesNothing) {
  constexpr std::int64_t kTick_ns = 1'000'000, kEnd_ns = 1000 * kTick_ns;
  const Motion far = Motion(test::at({5, 5, 5})).then(test::at({6, 5, 5}), 0, kEnd_ns);
  const Instance floor = test::place(1, test::floorModel(), Motion());
  const auto alone = makeSnapshot({floor}),
             beside = makeSnapshot({floor, test::place(2, test::boxModel(Vec3::Constant(0.1)), far)});
  const ProxySettings settings = piercing(1);
  ProxyState still = startProxy(*alone, settings, {0, 0.004, 0}), moved = startProxy(*beside, settings, {0, 0.004, 0});
  int within = 0;
  for (int i = 1; i < 400; ++i) {
    const std::int64_t now_ns = i * kTick_ns;
    const Vec3 finger(0, 0.004 - 2e-5 * i, 0);
    const TickReport judge = tick(still, {*alone, now_ns}, settings, finger);
    const TickReport report = tick(moved, {*beside, now_ns}, settings, finger);
    ASSERT_LT((still.position - moved.position).norm(), 10 * kRounding_m) << i;
    EXPECT_NEAR(report.moved_J, judge.moved_J, 1e-12) << i;
    within += !moved.pierced.empty() && std::abs(moved.position.y()) < kRadius ? 1 : 0;
  }
  EXPECT_GT(within, 20) << "it has been in the surface that it pierced";
}

// What has been pierced is in the way again as soon as the proxy no longer overlaps it, from its other side too.
TEST(Piercing, BeyondTheSurfaceItIsAsBeforeFromBelow) {
  const auto scene = test::snapshotOf(test::floorModel());
  const ProxySettings settings = piercing(2);
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  pressTo(state, *scene, settings, {0, 0.01, 0}, {0, -0.005, 0}, 100);
  EXPECT_TRUE(state.pierced.empty());
  EXPECT_NEAR(state.position.y(), -0.005, kRounding_m);
  pressTo(state, *scene, settings, {0, -0.005, 0}, {0, 0.0005, 0}, 50);
  EXPECT_NEAR(state.position.y(), -kRadius, 1e-9);
  pressTo(state, *scene, settings, {0, 0.0005, 0}, {0, 0.01, 0}, 50);
  EXPECT_NEAR(state.position.y(), 0.01, kRounding_m);
}

// Floors, each lower than the one before, with strengths of their own; 0: never pierced.
std::shared_ptr<const Snapshot> layers(std::initializer_list<std::pair<double, double>> heights_and_strengths) {
  std::vector<Instance> instances;
  for (const auto& [height, strength_N] : heights_and_strengths) {
    Model model = test::floorModel();
    for (Vec3& p : model.positions) p.y() = height;
    model.materials[0].strength_N = strength_N;
    Instance& instance = instances.emplace_back();
    instance.shape = makeShape(std::move(model), HierarchyKind::kBvh);
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = instances.size();
  }
  return makeSnapshot(std::move(instances));
}

ProxySettings asTheScene() {
  ProxySettings settings = piercing(0);
  settings.surfaces.strength_N.reset();
  return settings;
}

// Only the object that is pierced lets go: the floor beneath a skin holds.
TEST(Piercing, WhatLiesBehindHolds) {
  const auto scene = layers({{0, 1}, {-0.0005, 0}});
  const ProxySettings settings = asTheScene();
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  pressTo(state, *scene, settings, {0, 0.01, 0}, {0, -0.02, 0}, 100);
  EXPECT_NEAR(state.position.y(), kRadius - 0.0005, 1e-9);
  EXPECT_EQ(state.pierced.size(), 1U);
  pressTo(state, *scene, settings, {0, -0.02, 0}, {0, 0.01, 0}, 100);
  EXPECT_TRUE(state.pierced.empty());
}

TEST(Piercing, LayersLetGoOneAfterTheOther) {
  const auto scene = layers({{0, 1}, {-0.004, 3}, {-0.008, 2}, {-0.012, 0}});
  const ProxySettings settings = asTheScene();
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  const auto heightAt = [&](double finger) {
    tick(state, *scene, settings, {0, finger, 0});
    tick(state, *scene, settings, {0, finger, 0});
    return state.position.y();
  };
  EXPECT_NEAR(heightAt(kRadius - 0.00099), kRadius, 1e-9);
  EXPECT_NEAR(heightAt(kRadius - 0.00101), kRadius - 0.00101, 1e-9);
  EXPECT_NEAR(heightAt(kRadius - 0.004 - 0.00299), kRadius - 0.004, 1e-9);
  // The third is met at once, and presses with what it is deep: 3.01 - 4 mm is above it.
  EXPECT_NEAR(heightAt(kRadius - 0.004 - 0.00301), kRadius - 0.004 - 0.00301, 1e-9);
  EXPECT_NEAR(heightAt(kRadius - 0.008 - 0.00199), kRadius - 0.008, 1e-9);
  EXPECT_NEAR(heightAt(kRadius - 0.008 - 0.00201), kRadius - 0.008 - 0.00201, 1e-9);
  EXPECT_NEAR(heightAt(-0.1), kRadius - 0.012, 1e-9);
}

TEST(Piercing, ScalesWithTheWorkspaceAndTheSurfacesStiffness) {
  for (const double scale : {0.1, 1.0, 50.0}) {
    for (const double s : {0.5, 1.0}) {
      ProxySettings settings = piercing(1);
      settings.radius *= scale;
      settings.world_per_device = scale;
      settings.surfaces.stiffness = s;
      Model model = test::floorModel();
      for (Vec3& p : model.positions) p *= scale;
      const auto scene = test::snapshotOf(std::move(model));
      ProxyState state = startProxy(*scene, settings, scale * Vec3(0, 0.01, 0));
      const double most_D = 1 / (kK * s);
      for (int i = 0; i < 5; ++i) tick(state, *scene, settings, scale * Vec3(0, kRadius - 0.999 * most_D, 0));
      EXPECT_TRUE(state.pierced.empty()) << scale << " " << s;
      tick(state, *scene, settings, scale * Vec3(0, kRadius - 1.001 * most_D, 0));
      EXPECT_EQ(state.pierced.size(), 1U) << scale << " " << s;
    }
  }
}

// Whatever the finger does: no energy comes from it, and only what has been pierced is entered.
TEST(Piercing, NeverAddsEnergyAndEntersOnlyWhatItPierces) {
  const auto scene = layers({{0, 0.5}, {-0.003, 1.5}, {-0.0035, 0.2}, {-0.009, 0}, {0.006, 3}});
  std::mt19937 random(5);
  std::normal_distribution<double> jump(0, 4e-4);
  int pierced = 0;
  for (int run = 0; run < test::cases(20); ++run) {
    ProxySettings settings = asTheScene();
    if (run % 2 == 0) settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.6;
    if (run % 3 == 0) settings.surfaces.adhesion_N = 0.3;
    if (run % 5 == 0) settings.surfaces.compliance_m_N = 1e-3;
    ProxyState state = startProxy(*scene, settings, {0, 0.003, 0});
    Vec3 finger(0, 0.003, 0);
    for (int i = 0; i < 2000; ++i) {
      finger = (finger + Vec3(jump(random), jump(random), jump(random))).cwiseMin(0.02).cwiseMax(-0.02);
      const PiercedObjects before = state.pierced;
      const SceneAt now(*scene);
      const SceneAt felt(now, {before.begin(), before.size()});
      tick(state, now, settings, finger);
      ASSERT_GE(judge::clearance(felt, state.position, 1), kRadius * (1 - 1e-6));
      ASSERT_GE(state.position.y(), -0.009);
      pierced += state.pierced.size() > before.size() ? 1 : 0;
    }
    EXPECT_EQ(state.ledger.injected_J, 0);
  }
  EXPECT_GT(pierced, test::cases(20));
}

TEST(Piercing, IsRealTimeSafe) {
  const auto scene = layers({{0, 0.5}, {-0.003, 1.5}, {-0.009, 0}});
  const ProxySettings settings = asTheScene();
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  const SceneAt now(*scene);
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) tick(state, now, settings, {1e-4 * (i % 7), 0.02 * std::sin(0.1 * i), 0});
}

}  // namespace
}  // namespace hl::test_piercing
