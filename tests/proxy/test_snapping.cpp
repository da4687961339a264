// Snaps: points, lines, curves and planes that hold the proxy until it is pulled off.
#include "proxy/snapping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "moving_scenes.h"
#include "proxy/judge.h"
#include "proxy/object_forces.h"
#include "proxy/proxy.h"

namespace hl::test_snapping {
namespace {

constexpr double kK = 1000;
constexpr double kRadius = 1e-3;
constexpr double kRounding_m = 1e-15;

ProxySettings plain(LedgerMode ledger = LedgerMode::kTank) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.ledger = ledger;
  return settings;
}

SnapSpec curve(std::vector<Vec3> points, double capture_m = 1e-3, double release_N = 2) {
  return {"curve", std::move(points), {}, capture_m, release_N};
}
SnapSpec plane(const Vec3& point, const Vec3& normal, double capture_m = 1e-3, double release_N = 2) {
  return {"plane", {point}, normal, capture_m, release_N};
}

/// An object of nothing but snaps.
Instance snapsAt(std::uint64_t key, SnapList snaps, const Motion& motion = Motion(Pose{})) {
  Instance instance = test::place(key, {}, motion);
  instance.snaps = std::make_shared<const SnapList>(std::move(snaps));
  return instance;
}

std::shared_ptr<const Snapshot> sceneOf(SnapList snaps) { return makeSnapshot({snapsAt(1, std::move(snaps))}); }

Vec3 forceOf(const TickReport& report, const Vec3& finger) { return kK * (report.target - finger); }

/// A proxy that a snap has taken, with the finger at `place`.
ProxyState heldAt(const Snapshot& scene, const ProxySettings& settings, const Vec3& place) {
  ProxyState state = startProxy(scene, settings, place + Vec3(0.1, 0, 0));
  tick(state, scene, settings, place);
  EXPECT_TRUE(state.snap.holds());
  return state;
}

// The closed form: the spring pulls with K d until K d = 2 N; 1/2 K d^2 is lost then.
TEST(Snapping, TwoNewtonLetGoAtTwoMillimetres) {
  const auto scene = sceneOf({curve({{0.01, 0.02, 0.03}})});
  const Vec3 point(0.01, 0.02, 0.03), away = Vec3(1, -2, 2).normalized();
  ProxyState state = heldAt(*scene, plain(), point);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 finger = point + 1e-6 * i * away;
    const TickReport report = tick(state, *scene, plain(), finger);
    ASSERT_TRUE(touches(state, report));
    ASSERT_LE((state.position - point).norm(), 1e-14) << i;
    ASSERT_LE((forceOf(report, finger) + 1e-3 * i * away).norm(), 1e-10) << i;
  }
  tick(state, *scene, plain(), point + (2e-3 - 1e-12) * away);
  EXPECT_TRUE(state.snap.holds());
  const double before_J = state.ledger.dissipated_J;
  const Vec3 finger = point + (2e-3 + 1e-12) * away;
  const TickReport report = tick(state, *scene, plain(), finger);
  EXPECT_FALSE(state.snap.holds() || touches(state, report));
  EXPECT_LE(forceOf(report, finger).norm(), 1e-10);
  EXPECT_NEAR(state.ledger.dissipated_J - before_J, 2e-3, 1e-9);
  EXPECT_NEAR(report.injected_J, -2e-3, 1e-9);
}

TEST(Snapping, TakesTheProxyAtTheCaptureDistanceAndNotBefore) {
  const auto scene = sceneOf({curve({Vec3::Zero()})});
  for (const double part : {1 + 1e-9, 1 - 1e-9}) {
    ProxyState state = startProxy(*scene, plain(), {0.01, 0, 0});
    const Vec3 finger(part * 1e-3, 0, 0);
    const TickReport report = tick(state, *scene, plain(), finger);
    EXPECT_EQ(state.snap.holds(), part < 1);
    EXPECT_NEAR(forceOf(report, finger).norm(), part < 1 ? 1 : 0, 1e-6);
    EXPECT_NEAR(state.ledger.injected_J, part < 1 ? 0.5e-3 : 0, 1e-9);
  }
}

TEST(Snapping, ScalesWithTheWorkspace) {
  for (const double scale : {0.1, 1.0, 50.0}) {
    ProxySettings settings = plain();
    settings.world_per_device = scale;
    settings.radius *= scale;
    const auto scene = sceneOf({curve({Vec3::Zero()}, scale * 1e-3)});
    ProxyState state = heldAt(*scene, settings, Vec3::Zero());
    tick(state, *scene, settings, {0, scale * 1.999e-3, 0});
    EXPECT_TRUE(state.snap.holds()) << scale;
    const double before_J = state.ledger.dissipated_J;
    tick(state, *scene, settings, {0, scale * 2.001e-3, 0});
    EXPECT_FALSE(state.snap.holds()) << scale;
    EXPECT_NEAR(state.ledger.dissipated_J - before_J, 0.5 * kK * 2.001e-3 * 2.001e-3, 1e-8) << scale;
  }
}

TEST(Snapping, AlongALineThereIsNoForce) {
  test::Random random(1);
  for (int line = 0; line < 20; ++line) {
    const Vec3 a = random.inCube(0.1), along = random.direction();
    const auto scene = sceneOf({curve({a, a + 0.1 * along})});
    ProxyState state = heldAt(*scene, plain(), a + 0.05 * along);
    for (int i = 0; i < 200; ++i) {
      const Vec3 across = (random.inCube(1).cross(along)).normalized();
      const Vec3 finger = a + random.uniform(0, 0.1) * along + random.uniform(0, 1.9e-3) * across;
      const TickReport report = tick(state, *scene, plain(), finger);
      ASSERT_TRUE(state.snap.holds());
      ASSERT_LE(std::abs(forceOf(report, finger).dot(along)), 1e-12);
    }
  }
}

TEST(Snapping, ALineEndsAtItsEnds) {
  const auto scene = sceneOf({curve({Vec3::Zero(), {0.1, 0, 0}})});
  ProxyState state = heldAt(*scene, plain(), {0.05, 0, 0});
  const Vec3 finger(0.1015, 0, 0);
  EXPECT_NEAR(forceOf(tick(state, *scene, plain(), finger), finger).x(), -1.5, 1e-9);
}

TEST(Snapping, APlaneIsAWallOfTwoSides) {
  test::Random random(2);
  const Vec3 normal = Vec3(1, 2, 3).normalized(), point(0.01, 0, 0);
  const auto scene = sceneOf({plane(point, normal)});
  ProxyState state = heldAt(*scene, plain(), point);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 aside = random.inCube(0.01).cross(normal);
    const double height_m = random.uniform(-1.99e-3, 1.99e-3);
    const Vec3 finger = point + aside + height_m * normal;
    const TickReport report = tick(state, *scene, plain(), finger);
    const Vec3 force = forceOf(report, finger);
    ASSERT_LE((force + kK * height_m * normal).norm(), 1e-11) << i;
  }
  const Vec3 finger = point - 2.001e-3 * normal;
  EXPECT_LE(forceOf(tick(state, *scene, plain(), finger), finger).norm(), 1e-12);
}

// A finger that takes the corner too short, 1 mm beside the curve, is led around it.
TEST(Snapping, ACurveLeadsAroundACorner) {
  const auto scene = sceneOf({curve({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}})});
  ProxyState state = heldAt(*scene, plain(), {0.05, 0, 0});
  for (int i = 0; i <= 1000; ++i) {
    const Vec3 finger(std::min(0.099, 0.05 + 1e-4 * i), std::max(0.001, 1e-4 * i - 0.048), 0);
    tick(state, *scene, plain(), finger);
    const double to_first_m = finger.y(), to_second_m = 0.1 - finger.x();
    const Vec3 expected = to_first_m <= to_second_m ? Vec3(finger.x(), 0, 0) : Vec3(0.1, finger.y(), 0);
    ASSERT_LE((state.position - expected).norm(), kRounding_m) << i;
  }
  EXPECT_GT(state.position.y(), 0.05);
}

TEST(Snapping, TheNearestOneTakesTheProxyAndKeepsIt) {
  const auto scene = sceneOf({curve({Vec3(0, 0, 0)}), curve({Vec3(1e-3, 0, 0)}), curve({Vec3(1e-3, 0, 0)})});
  ProxyState state = heldAt(*scene, plain(), {0.6e-3, 0, 0});
  EXPECT_EQ(state.snap.number, 1U);
  tick(state, *scene, plain(), {0, 0, 0});
  EXPECT_EQ(state.snap.number, 1U);
  EXPECT_LE((state.position - Vec3(1e-3, 0, 0)).norm(), kRounding_m);
}

// A line beneath a floor: the proxy is on the floor above it, follows it without friction, and is never in the floor.
TEST(Snapping, TheProxyNeverEntersWhatIsBesideTheSnap) {
  test::Random random(3);
  Instance floor = test::place(1, test::floorModel(), Motion(Pose{}));
  const auto scene = makeSnapshot({floor, snapsAt(2, {curve({{-0.05, 0, 0}, {0.05, 0, 0}}, 5e-3, 6)})});
  ProxyState state = heldAt(*scene, plain(), {0, 1.5e-3, 0});
  for (int i = 0; i < test::cases(20000); ++i) {
    const Vec3 finger(random.uniform(-0.04, 0.04), random.uniform(-3e-3, 3e-3), random.uniform(-3e-3, 3e-3));
    const TickReport report = tick(state, *scene, plain(), finger);
    ASSERT_TRUE(state.snap.holds());
    ASSERT_GE(judge::clearance(*scene, state.position, 2 * kRadius), kRadius * (1 - 1e-9)) << i;
    ASSERT_LE((state.position - Vec3(finger.x(), kRadius, 0)).norm(), 1e-9) << i;
    ObjectForces forces = objectForces(*scene, plain(), state, report, finger);
    ASSERT_EQ(forces.size(), 2U);
    ASSERT_LE((forces[0].force_N - Vec3(0, kK * kRadius, 0)).norm(), 1e-6);
    ASSERT_LE((forces[1].force_N + kK * Vec3(0, finger.y(), finger.z())).norm(), 1e-6);
  }
}

TEST(Snapping, ARoughFloorHoldsTheProxyAgainstTheSnap) {
  Instance floor = test::place(1, test::floorModel(), Motion(Pose{}));
  const auto scene = makeSnapshot({floor, snapsAt(2, {curve({{0, -1e-3, 0}}, 5e-3, 6)})});
  ProxySettings settings = plain();
  settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.5;
  ProxyState state = startProxy(*scene, settings, {2e-3, 2e-3, 0});
  Vec3 finger(2e-3, 2e-3, 0);
  for (int i = 0; i < 100; ++i) tick(state, *scene, settings, finger);
  EXPECT_NEAR(state.position.y(), kRadius, 1e-9);
  EXPECT_NEAR(state.position.x(), 0.5 * 2e-3, 1e-6);  // |pull along| = mu |pull down|, from 2 mm to the snap's foot
}

// The spring's energy that the snap has given, from each capture to its release.
double worstCycle_J(const Snapshot& scene, const ProxySettings& settings, int seed, int& cycles) {
  test::Random random(static_cast<std::uint64_t>(seed));
  ProxyState state = startProxy(scene, settings, {0.01, 0, 0});
  Vec3 finger(0.01, 0, 0);
  double cycle_J = 0, worst_J = -1;
  for (int i = 0; i < test::cases(20000); ++i) {
    finger += random.inCube(1e-3);
    for (int k = 0; k < 3; ++k) finger[k] = std::clamp(finger[k], -0.01, 0.01);
    const bool was_held = state.snap.holds();
    const TickReport report = tick(state, scene, settings, finger);
    if (was_held || state.snap.holds()) cycle_J += report.injected_J;
    if (!was_held || state.snap.holds()) continue;
    worst_J = std::max(worst_J, cycle_J);
    cycle_J = 0;
    ++cycles;
  }
  return worst_J;
}

TEST(Snapping, NoCycleOfCaptureAndReleaseGivesEnergy) {
  int cycles = 0;
  for (const double capture_m : {0.5e-3, 2e-3, 8e-3}) {
    for (const double release_N : {0.7, 2.0, 5.0}) {
      for (const SnapSpec& snap :
           {curve({Vec3::Zero()}, capture_m, release_N), curve({{-0.1, 0, 0}, {0.1, 0, 0}}, capture_m, release_N),
            curve({{-0.1, 0, 0}, {0, 0, 0}, {0, 0.1, 0}}, capture_m, release_N),
            plane(Vec3::Zero(), Vec3::UnitY(), capture_m, release_N)}) {
        const auto scene = sceneOf({snap});
        for (const LedgerMode mode : {LedgerMode::kReport, LedgerMode::kTank})
          EXPECT_LE(worstCycle_J(*scene, plain(mode), 7, cycles), 1e-9) << capture_m << " " << release_N;
      }
    }
  }
  EXPECT_GT(cycles, test::cases(5000));
}

TEST(Snapping, AStrictLedgerLetsNoTickAddEnergy) {
  test::Random random(4);
  const auto scene = sceneOf({curve({Vec3::Zero()}), plane({0, 3e-3, 0}, Vec3::UnitY())});
  ProxyState state = startProxy(*scene, plain(LedgerMode::kStrict), {0.01, 0, 0});
  Vec3 finger(0.005, 0, 0);
  int held = 0;
  for (int i = 0; i < test::cases(20000); ++i) {
    finger = 0.99 * finger + random.inCube(5e-4);
    ASSERT_LE(tick(state, *scene, plain(LedgerMode::kStrict), finger).injected_J, 1e-15) << i;
    held += state.snap.holds() ? 1 : 0;
  }
  EXPECT_GT(held, test::cases(1000));
}

// 0.5 mJ each from a tank of 10 mJ: what the releases take out of the spring pays for the captures.
TEST(Snapping, ATankDoesNotRunDryByCaptures) {
  const auto scene = sceneOf({curve({Vec3::Zero()})});
  ProxyState state = startProxy(*scene, plain(), {0.01, 0, 0});
  for (int cycle = 0; cycle < 1000; ++cycle) {
    tick(state, *scene, plain(), {1e-3, 0, 0});
    ASSERT_TRUE(state.snap.holds());
    ASSERT_LE(state.position.norm(), kRounding_m) << cycle;
    tick(state, *scene, plain(), {2.1e-3, 0, 0});
    ASSERT_FALSE(state.snap.holds());
  }
}

// 12.5 mJ of which the tank has 10: it goes as near as 10 mJ allow, and never beyond.
TEST(Snapping, WhatTheTankCannotPayIsNotDone) {
  const auto scene = sceneOf({curve({Vec3::Zero()}, 5e-3, 10)});
  ProxyState state = startProxy(*scene, plain(), {0.01, 0, 0});
  tick(state, *scene, plain(), {6e-3, 0, 0});
  tick(state, *scene, plain(), {5e-3, 0, 0});
  EXPECT_TRUE(state.snap.holds());
  EXPECT_NEAR(state.ledger.tank_J, 0, 1e-12);
  EXPECT_NEAR(0.5 * kK * (state.position - Vec3(5e-3, 0, 0)).squaredNorm(), 0.010, 1e-9);
}

// What moves takes the snap and the proxy along; the energy is that of what moves, and no tank pays for it.
TEST(Snapping, AnObjectThatMovesCarriesItsSnap) {
  constexpr std::int64_t kMs = 1'000'000;
  const Motion motion = Motion(Pose{}).then(test::at({0.0015, 0, 0}), 0, 100 * kMs);
  const auto scene = makeSnapshot({snapsAt(1, {curve({{0, 0.01, 0}})}, motion)});
  ProxyState state = startProxy(*scene, plain(), {0.1, 0, 0});
  const Vec3 finger(0, 0.01, 0);
  tick(state, *scene, plain(), finger);
  ASSERT_TRUE(state.snap.holds());
  double moved_J = 0, injected_J = 0;
  for (int i = 1; i <= 120; ++i) {
    const TickReport report = tick(state, SceneAt(*scene, i * kMs), plain(), finger);
    moved_J += report.moved_J;
    injected_J += std::abs(report.injected_J);
    ASSERT_NEAR(state.position.x(), 1.5e-5 * std::min(i, 100), 1e-12);
    ASSERT_NEAR(forceOf(report, finger).x(), 1.5e-2 * std::min(i, 100), 1e-9);
  }
  EXPECT_NEAR(moved_J, 0.5 * kK * 1.5e-3 * 1.5e-3, 1e-9);
  EXPECT_NEAR(injected_J, 0, 1e-12);
}

TEST(Snapping, LetsGoWhereTheSnapIsGone) {
  const auto scene = sceneOf({curve({Vec3::Zero()})});
  ProxyState state = heldAt(*scene, plain(), {5e-4, 0, 0});
  const auto bare = makeSnapshot({test::place(1, {}, Motion(Pose{}))});
  tick(state, *bare, plain(), {5e-4, 0, 0});
  EXPECT_FALSE(state.snap.holds());
  ProxyState other = heldAt(*scene, plain(), {5e-4, 0, 0});
  other.snap.number = 3;  // as a recording may say
  tick(other, *scene, plain(), {5e-4, 0, 0});
  EXPECT_EQ(other.snap.number, 0U);
}

TEST(Snapping, TakesNoMemory) {
  test::Random random(5);
  SnapList snaps;
  for (std::size_t i = 0; i < kMaxSnaps; ++i) snaps.push_back(curve({random.inCube(0.01), random.inCube(0.01)}));
  Instance floor = test::place(1, test::floorModel(), Motion(Pose{}));
  const auto scene = makeSnapshot({floor, snapsAt(2, snaps)});
  const ProxySettings settings = plain();
  ProxyState state = startProxy(*scene, settings, {0.01, 0.01, 0});
  int held = 0;
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) {
    tick(state, *scene, settings, random.inCube(0.01));
    held += state.snap.holds() ? 1 : 0;
  }
  EXPECT_GT(held, 10);
}

// No more than may count.
TEST(Snapping, ASceneCountsSoManySnapsAndPoints) {
  const SnapList many(kMaxSnaps + 6, curve({Vec3::Zero()}));
  EXPECT_EQ(sceneOf(many)->snaps.size(), kMaxSnaps);
  const SnapList long_ones(kMaxSnaps, curve(std::vector<Vec3>(kMaxCorners, Vec3::Zero())));
  EXPECT_EQ(sceneOf(long_ones)->snaps.size(), kMaxSnapPoints / kMaxCorners);
}

// Obstacles of all kinds among snaps of all kinds: the proxy is clear of them, and no tick adds more than the tank has.
TEST(Snapping, AmongObstaclesNothingIsEnteredAndAllEnergyIsPaid) {
  test::Random random(6);
  for (int run = 0; run < test::cases(40); ++run) {
    std::vector<std::array<Vec3, 3>> soup;
    for (int i = 0; i < 30; ++i) soup.push_back({random.inCube(0.02), random.inCube(0.02), random.inCube(0.02)});
    SnapList snaps;
    for (int i = 0; i < 8; ++i)
      snaps.push_back(curve({random.inCube(0.02), random.inCube(0.02), random.inCube(0.02)}, 2e-3, 4));
    snaps.push_back(plane(random.inCube(0.02), random.direction(), 2e-3, 4));
    const auto scene = makeSnapshot({test::place(1, judge::triangles(soup), Motion(Pose{})), snapsAt(2, snaps)});
    ProxySettings settings = plain(run % 2 == 0 ? LedgerMode::kTank : LedgerMode::kStrict);
    settings.surfaces.static_friction = settings.surfaces.dynamic_friction = run % 3 == 0 ? 0.4 : 0.0;
    ProxyState state = startProxy(*scene, settings, {0.05, 0, 0});
    Vec3 finger(0.05, 0, 0);
    for (int i = 0; i < 2000; ++i) {
      finger = 0.998 * finger + random.inCube(1e-3);
      const double budget_J = state.ledger.budget_J(settings.ledger);
      const TickReport report = tick(state, *scene, settings, finger);
      ASSERT_GE(judge::clearance(*scene, state.position, 2 * kRadius), kRadius * (1 - 1e-6)) << run << ", " << i;
      ASSERT_LE(report.injected_J, budget_J + 1e-12) << run << ", " << i;
    }
  }
}

}  // namespace
}  // namespace hl::test_snapping
