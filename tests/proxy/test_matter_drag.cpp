// Matter drag: what hinders a proxy within the matter of a volume.
#include "proxy/matter_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "cases.h"
#include "effect_scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"
#include "surfaces/iso_surface.h"

namespace hl::test_matter_drag {
namespace {

constexpr double kK = 1000;
constexpr double kPeriod_s = 1e-3;

ProxySettings plainSettings() {
  ProxySettings settings;
  settings.radius = 0.001;
  settings.spring_N_m = kK;
  settings.period_s = kPeriod_s;
  return settings;
}

/// A cube of 0.16 m about the origin, of the value 0 below y = -0.08 m to 160 above y = 0.08 m; its surface lies at
/// y = 0, with matter below it.
Instance block(std::vector<MatterRow> rows, double strength_N = 0) {
  constexpr std::uint32_t kSide = 17;
  auto samples = std::make_shared<std::vector<float>>();
  for (std::uint32_t z = 0; z < kSide; ++z) {
    for (std::uint32_t y = 0; y < kSide; ++y) {
      for (std::uint32_t x = 0; x < kSide; ++x) samples->push_back(10 * static_cast<float>(y));
    }
  }
  const std::shared_ptr<const void> data(samples, samples->data());
  const auto volume =
      std::make_shared<const Volume>(VoxelGrid({kSide, kSide, kSide}, Samples(SampleKind::kFloat32, data)));
  const GridFrame frame{0.01 * Mat3::Identity(), Vec3::Constant(-0.08)};
  auto source = std::make_shared<const IsoSurface>(volume, frame, IsoValue{80, SolidSide::kBelow},
                                                   std::make_shared<const MatterTable>(std::move(rows)));
  Material material;
  material.strength_N = strength_N;
  Instance instance;
  instance.shape = makeShape(std::move(source), material);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  return instance;
}

MatterRow row(double value, double resistance_N, double drag_Ns_m) {
  return {.value = value, .force = {resistance_N, drag_Ns_m}};
}

double forceAfter(ProxyState& state, const Snapshot& scene, const Vec3& from, const Vec3& velocity, double time_s) {
  TickReport report;
  Vec3 finger = from;
  for (int i = 1; i * kPeriod_s <= time_s; ++i) {
    finger = from + i * kPeriod_s * velocity;
    report = tick(state, scene, plainSettings(), finger);
  }
  return kK * (report.target - finger).norm();
}

// F + b v, at a steady speed.
TEST(MatterDrag, FiveNewtonSecondsPerMetreAtATenthOfAMetrePerSecondAreHalfANewton) {
  const auto scene = makeSnapshot({block({row(0, 0, 5)})});
  ProxyState state = startProxy(*scene, plainSettings(), {-0.07, -0.02, 0});
  EXPECT_NEAR(forceAfter(state, *scene, {-0.07, -0.02, 0}, {0.1, 0, 0}, 0.5), 0.5, 0.0005);
}

TEST(MatterDrag, AResistanceHoldsWhatPullsWithLessAndAddsToTheDrag) {
  const auto scene = makeSnapshot({block({row(0, 0.2, 5)})});
  ProxyState state = startProxy(*scene, plainSettings(), {-0.07, -0.02, 0});
  EXPECT_NEAR(forceAfter(state, *scene, {-0.07, -0.02, 0}, {0.00019, 0, 0}, 1), 0.19, 1e-9);
  EXPECT_EQ(state.position, Vec3(-0.07, -0.02, 0));
  EXPECT_NEAR(forceAfter(state, *scene, {-0.07, -0.02, 0}, {0.1, 0, 0}, 0.5), 0.7, 0.0007);
  EXPECT_NEAR(forceAfter(state, *scene, {-0.02, -0.02, 0}, Vec3::Zero(), 1), 0.2, 1e-6);
}

// Between the rows of the table, and by the value where the proxy is.
TEST(MatterDrag, FollowsTheValue) {
  const auto scene = makeSnapshot({block({row(0, 0, 0), row(80, 0, 8)})});
  for (const double y : {-0.06, -0.035, -0.01}) {
    ProxyState state = startProxy(*scene, plainSettings(), {-0.07, y, 0});
    const double drag = 8 * (y + 0.08) / 0.08;
    EXPECT_NEAR(forceAfter(state, *scene, {-0.07, y, 0}, {0.1, 0, 0}, 0.5), 0.1 * drag, 1e-3 * drag) << y;
  }
}

// The surface holds until it is pierced; within, the matter holds back; and outside of the volume nothing does.
TEST(MatterDrag, ANeedleIsFeltThroughTheSurfaceAndBeyond) {
  const auto scene = makeSnapshot({block({row(0, 0, 4), row(80, 0, 4), row(80.001, 0, 0)}, 2)});
  ProxyState state = startProxy(*scene, plainSettings(), {0.003, 0.02, 0.002});
  const auto downFrom = [&](double y, double time_s) {
    return forceAfter(state, *scene, {0.003, y, 0.002}, {0, -0.1, 0}, time_s);
  };
  EXPECT_NEAR(downFrom(0.02, 0.2095), 1.9, 1e-6);     // to y = -0.9 mm: not yet pierced
  EXPECT_NEAR(downFrom(-0.0009, 0.4005), 0.4, 1e-3);  // to -40.9 mm
  EXPECT_EQ(downFrom(-0.0409, 0.5005), 0);            // to -90.9 mm, outside
}

// A surface that stops the proxy is pressed by the whole pull, as what does not move is not dragged.
TEST(MatterDrag, ASurfaceWithinMatterIsPressedByTheSpringAlone) {
  const auto scene = makeSnapshot({block({row(0, 0, 20)}, 1.5)});
  ProxyState state = startProxy(*scene, plainSettings(), {0.003, -0.03, 0.002});
  forceAfter(state, *scene, {0.003, -0.03, 0.002}, {0, 0.01, 0}, 2.9);  // to y = -1 mm, against the surface
  const Vec3 pressed(0.003, -0.001 + 1.4e-3, 0.002);
  TickReport report;
  for (int i = 0; i < 100; ++i) report = tick(state, *scene, plainSettings(), pressed);
  ASSERT_EQ(report.contacts.size(), 1U);
  EXPECT_NEAR(kK * report.contacts[0].multiplier_m, 1.4, 1e-6);
  EXPECT_NEAR(report.held_pull_m.norm(), 0, 1e-9);
  EXPECT_TRUE(state.pierced.empty());
  EXPECT_NEAR(forceAfter(state, *scene, pressed, {0, 0.001, 0}, 0.099), 1.499, 1e-6);
  forceAfter(state, *scene, pressed + Vec3(0, 1e-4, 0), {0, 0.1, 0}, 0.005);
  EXPECT_GT(state.position.y(), -0.0009);
}

Instance softBlock(std::vector<MatterRow> rows, double strength_N, double stiffness) {
  Instance soft = block(std::move(rows), strength_N);
  auto surfaces = std::make_shared<Surfaces>(*soft.surfaces);
  surfaces->materials[0].stiffness = stiffness;
  soft.surfaces = std::move(surfaces);
  return soft;
}

// Of K s as the surface has made it, whether the surface or the resistance holds the proxy.
TEST(MatterDrag, ASoftSurfaceIsFeltTheSameFromTickToTick) {
  const auto scene = makeSnapshot({softBlock({row(0, 0.5, 0)}, 0, 0.5)});
  ProxyState state = startProxy(*scene, plainSettings(), {0.003, 0.002, 0.002});
  forceAfter(state, *scene, {0.003, 0.002, 0.002}, {0, -0.01, 0}, 0.2605);  // 1.6 mm deep
  for (const double depth_m : {1.6e-3, 0.65e-3, 0.3e-3}) {
    const Vec3 parked(0.003, 0.001 - depth_m, 0.002);
    for (int i = 0; i < 20; ++i)
      EXPECT_NEAR(forceAfter(state, *scene, parked, Vec3::Zero(), kPeriod_s), 0.5 * kK * depth_m, 1e-9) << depth_m;
  }
}

// Once the surface lets go the force falls to F + b v, with and without a tank of energy, and the spring is K again.
TEST(MatterDrag, BeyondASoftSurfaceTheForceFalls) {
  for (const LedgerMode ledger : {LedgerMode::kTank, LedgerMode::kStrict}) {
    const auto scene = makeSnapshot({softBlock({row(0, 0.2, 5)}, 1, 0.5)});
    ProxySettings settings = plainSettings();
    settings.ledger = ledger;
    ProxyState state = startProxy(*scene, settings, {0.003, 0.002, 0.002});
    double before_N = 0, greatest_N = 0;
    for (int i = 1; i <= 600; ++i) {
      const Vec3 finger(0.003, 0.002 - i * 1e-5, 0.002);  // 0.01 m/s
      const bool pierced = !state.pierced.empty();
      const TickReport report = tick(state, *scene, settings, finger);
      const double force_N = kK * (report.target - finger).norm();
      EXPECT_TRUE(!pierced || force_N <= std::max(before_N, 0.25) + 1e-9) << i;
      before_N = force_N;
      greatest_N = std::max(greatest_N, force_N);
    }
    EXPECT_NEAR(greatest_N, 1.2, 0.01);  // the strength, and what the matter about the surface holds back
    EXPECT_NEAR(before_N, 0.25, 1e-6);
    EXPECT_EQ(state.stiffness, 1);
    EXPECT_EQ(state.ledger.injected_J, 0);
  }
}

// Whatever the finger does: the spring never gets energy from matter, and surfaces are never entered.
TEST(MatterDrag, NeverAddsEnergyAndEntersNothing) {
  Instance floor;
  Model model = test::floorModel();
  for (Vec3& p : model.positions) p.y() -= 0.03;
  floor.shape = makeShape(std::move(model), HierarchyKind::kBvh);
  floor.surfaces = surfacesOf(floor.shape);
  floor.key = 2;
  const auto scene = makeSnapshot({block({row(0, 0.3, 20), row(160, 0, 0)}), floor});
  std::mt19937 random(7);
  std::normal_distribution<double> jump(0, 1e-3);
  for (int run = 0; run < test::cases(20); ++run) {
    ProxySettings settings = plainSettings();
    if (run % 2 == 0) settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.5;
    Vec3 finger(0, run % 2 == 0 ? -0.01 : 0.01, 0);
    ProxyState state = startProxy(*scene, settings, finger);
    for (int i = 0; i < 2000; ++i) {
      finger = (finger + Vec3(jump(random), jump(random), jump(random))).cwiseMin(0.05).cwiseMax(-0.05);
      const double before = (state.position - finger).norm();
      tick(state, *scene, settings, finger);
      ASSERT_LE((state.position - finger).norm(), before + 1e-12);
      ASSERT_GE(judge::clearance(*scene, state.position, 2 * settings.radius), settings.radius * (1 - 1e-6));
    }
    EXPECT_EQ(state.ledger.injected_J, 0);
  }
}

// A tick asks a few objects alone: those that hinder go before those that do not, whatever their number.
TEST(MatterDrag, IsFeltBesideManyOtherVolumes) {
  std::vector<Instance> instances;
  for (std::uint64_t key = 1; key <= 40; ++key) {
    instances.push_back(key == 40 ? block({row(0, 0, 5)}) : block({}));
    instances.back().key = key;
  }
  const auto snapshot = makeSnapshot(std::move(instances));
  ASSERT_EQ(snapshot->matter.size(), kMaxMatter);
  EXPECT_EQ(snapshot->instances[snapshot->matter.front()].key, 40U);
}

TEST(MatterDrag, IsRealTimeSafe) {
  const auto scene = makeSnapshot({block({row(0, 0.1, 5)}, 1)});
  const ProxySettings settings = plainSettings();
  ProxyState state = startProxy(*scene, settings, {0, -0.02, 0});
  const SceneAt now(*scene);
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) tick(state, now, settings, {1e-4 * (i % 7), 0.03 * std::sin(0.1 * i), 0});
}

}  // namespace
}  // namespace hl::test_matter_drag
