// Adhesion: a surface keeps the proxy until it is pulled off by more than its adhesion.
#include "proxy/adhesion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cases.h"
#include "effect_scenes.h"
#include "guard/realtime_guard.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"
#include "solids.h"

namespace hl::test_adhesion {
namespace {

constexpr double kK = 1000;
constexpr double kRadius = 0.001;
constexpr double kRounding_m = 1e-12;

ProxySettings adhesive(double adhesion_N) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.surfaces.adhesion_N = adhesion_N;
  return settings;
}

Vec3 forceOf(const TickReport& report, const Vec3& finger) { return kK * (report.target - finger); }

/// A proxy that rests on the floor, under a finger 0.1 mm deep.
ProxyState restingOn(const Snapshot& scene, const ProxySettings& settings) {
  ProxyState state = startProxy(scene, settings, {0, 0.01, 0});
  for (int i = 0; i < 5; ++i) tick(state, scene, settings, {0, kRadius - 1e-4, 0});
  return state;
}

// The closed form: the spring pulls with K d until K d = A; 1/2 K d^2 is lost then.
TEST(Adhesion, OneNewtonLetsGoAtOneNewtonAndHalfAMillijouleIsLost) {
  const auto scene = test::snapshotOf(test::floorModel());
  const ProxySettings settings = adhesive(1);
  ProxyState state = restingOn(*scene, settings);
  for (int i = 0; i <= 999; ++i) {
    const Vec3 finger(0, kRadius + 1e-6 * i, 0);
    const TickReport report = tick(state, *scene, settings, finger);
    ASSERT_NEAR(state.position.y(), kRadius, kRounding_m) << i;
    ASSERT_NEAR(forceOf(report, finger).y(), -1e-3 * i, 1e-9);
    ASSERT_EQ(report.contacts.size(), 1U);
    ASSERT_NEAR(report.contacts[0].multiplier_m, -1e-6 * i, 1e-10);
  }
  const double before_J = state.ledger.dissipated_J;
  const Vec3 finger(0, kRadius + 1.001e-3, 0);
  const TickReport report = tick(state, *scene, settings, finger);
  EXPECT_EQ(report.contacts.size(), 0U);
  EXPECT_NEAR((state.position - finger).norm(), 0, kRounding_m);
  EXPECT_NEAR(state.ledger.dissipated_J - before_J, 0.5e-3 * 1.001 * 1.001, 1e-9);
  EXPECT_EQ(state.ledger.injected_J, 0);
}

TEST(Adhesion, ScalesWithTheWorkspaceAndTheSurfacesStiffness) {
  for (const double scale : {0.1, 1.0, 50.0}) {
    for (const double s : {0.5, 1.0}) {
      ProxySettings settings = adhesive(1);
      settings.radius *= scale;
      settings.world_per_device = scale;
      settings.surfaces.stiffness = s;
      Model model = test::floorModel();
      for (Vec3& p : model.positions) p *= scale;
      const auto scene = test::snapshotOf(std::move(model));
      ProxyState state = startProxy(*scene, settings, scale * Vec3(0, 0.01, 0));
      for (int i = 0; i < 5; ++i) tick(state, *scene, settings, scale * Vec3(0, 0.9 * kRadius, 0));
      const double most_D = 1 / (kK * s);
      tick(state, *scene, settings, scale * Vec3(0, kRadius + 0.999 * most_D, 0));
      EXPECT_TRUE(state.touching) << scale << " " << s;
      tick(state, *scene, settings, scale * Vec3(0, kRadius + 1.001 * most_D, 0));
      EXPECT_FALSE(state.touching) << scale << " " << s;
    }
  }
}

TEST(Adhesion, OfAScenesMaterialActsWhereItIsAndNowhereElse) {
  Model model = test::floorModel();
  model.materials[0].adhesion_N = 0.3;
  const auto scene = test::snapshotOf(std::move(model));
  ProxySettings settings = adhesive(0);
  settings.surfaces.adhesion_N.reset();
  ProxyState state = restingOn(*scene, settings);
  tick(state, *scene, settings, {0, kRadius + 0.29e-3, 0});
  EXPECT_TRUE(state.touching);
  settings.surfaces.adhesion_N = 0;  // the user's word goes over the scene's
  tick(state, *scene, settings, {0, kRadius + 0.29e-3, 0});
  EXPECT_FALSE(state.touching);
}

// Without friction the proxy stays below the finger.
TEST(Adhesion, AProxyThatIsPulledSlidesAlong) {
  const auto scene = test::snapshotOf(test::floorModel());
  const ProxySettings settings = adhesive(1);
  ProxyState state = restingOn(*scene, settings);
  for (int i = 0; i < 200; ++i) {
    const Vec3 finger(1e-4 * i, kRadius + 0.5e-3, -0.5e-4 * i);
    tick(state, *scene, settings, finger);
    ASSERT_NEAR((state.position - Vec3(finger.x(), kRadius, finger.z())).norm(), 0, 1e-9) << i;
  }
}

// Coulomb friction under the load N + A: a finger that presses with N may pull sideways by mu (N + A), also where A
// would stretch the spring by many radii.
class AdhesionAndFriction : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(AdhesionAndFriction, TheAdhesionAddsToTheLoad) {
  const auto [adhesion_N, stiffness] = GetParam();
  const auto scene = test::snapshotOf(test::floorModel());
  ProxySettings settings = adhesive(adhesion_N);
  settings.surfaces.stiffness = stiffness;
  settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.5;
  ProxyState state = restingOn(*scene, settings);
  const double load_N = kK * stiffness * 0.2e-3 + adhesion_N, most_m = 0.5 * load_N / (kK * stiffness);
  Vec3 finger(0, kRadius - 0.2e-3, 0);
  for (int i = 0; i < 10; ++i) tick(state, *scene, settings, finger);
  const Vec3 stuck = state.position;
  finger.x() = stuck.x() + 0.99 * most_m;
  for (int i = 0; i < 10; ++i) tick(state, *scene, settings, finger);
  EXPECT_NEAR((state.position - stuck).norm(), 0, kRounding_m);
  finger.x() = stuck.x() + 1.5 * most_m;
  for (int i = 0; i < 10; ++i) tick(state, *scene, settings, finger);
  EXPECT_NEAR(finger.x() - state.position.x(), most_m, 1e-9 + 1e-9 * most_m);
}
INSTANTIATE_TEST_SUITE_P(Newtons, AdhesionAndFriction,
                         testing::Values(std::pair{0.4, 1.0}, std::pair{0.4, 0.2}, std::pair{2.0, 1.0},
                                         std::pair{5.0, 1.0}, std::pair{5.0, 0.2}));

// A surface without stiffness pulls by nothing, so no adhesion is too little, and none makes a place that is no number.
TEST(Adhesion, OfASurfaceWithoutStiffnessLeavesThePlaceANumber) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double friction : {0.0, 0.5}) {
    ProxySettings settings = adhesive(1);
    settings.surfaces.stiffness = 0;
    settings.surfaces.viscosity_Ns_m = 5;
    settings.surfaces.static_friction = settings.surfaces.dynamic_friction = friction;
    ProxyState state = restingOn(*scene, settings);
    for (int i = 0; i < 100; ++i) {
      const Vec3 finger(1e-4 * i, kRadius + 1e-5 * (i - 50), 0);
      const TickReport report = tick(state, *scene, settings, finger);
      ASSERT_TRUE(state.position.allFinite() && report.target.allFinite()) << friction << " " << i;
      ASSERT_NEAR(forceOf(report, finger).norm(), 0, 1e-9);
    }
  }
}

// Over the edges and corners of a ball of few faces, pulled by several times its radius: it stays under the finger.
TEST(Adhesion, OfManyRadiiFollowsEdges) {
  constexpr double kBall_m = 0.004, kLead_rad = M_PI / 1800;
  for (const double adhesion_N : {2.0, 5.0, 20.0}) {
    for (const std::size_t sides : {8U, 20U, 40U}) {
      for (const double part : {0.3, 0.6}) {
        const auto scene = makeSnapshot(ballSolid(kBall_m, sides));
        const ProxySettings settings = adhesive(adhesion_N);
        const double height = kBall_m + kRadius + part * adhesion_N / kK;
        ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
        for (int i = 0; i < 5; ++i) tick(state, *scene, settings, {0, kBall_m + 0.9 * kRadius, 0});
        for (int i = 0; i <= 900; ++i) {
          const Vec3 outward = Vec3(std::sin(i * kLead_rad), std::cos(i * kLead_rad), 0.1).normalized();
          tick(state, *scene, settings, height * outward);
          ASSERT_TRUE(state.touching) << adhesion_N << " " << sides << " " << part << " " << i;
          ASSERT_GT(state.position.normalized().dot(outward), 0.95);
        }
        EXPECT_EQ(state.ledger.injected_J, 0);
      }
    }
  }
}

// Over the edges of a prism of 60 sides, pulled outward by half of what it withstands.
TEST(Adhesion, FollowsASurfaceThatFallsAway) {
  const auto scene = test::prism(60);
  ProxySettings settings = adhesive(1);
  settings.radius = 0.01;
  settings.world_per_device = 10;
  ProxyState state = startProxy(*scene, settings, {1.1, 0, 0});
  for (int i = 0; i < 5; ++i) tick(state, *scene, settings, {0.999, 0, 0});
  for (int i = 0; i < 1000; ++i) {
    const double angle = 1e-3 * i;
    const Vec3 finger = (1 + 0.01 + 0.005) * Vec3(std::cos(angle), std::sin(angle), 0);
    tick(state, *scene, settings, finger);
    ASSERT_TRUE(state.touching) << i;
    ASSERT_LE((state.position - finger).norm(), 0.0105);
  }
}

// Each wall lets go by itself: off the one, along the other.
TEST(Adhesion, InACornerOneWallLetsGoAndTheOtherKeeps) {
  Model model = test::floorModel();
  test::addRectangle(model, {0, 0, 0.1}, {0, 0, -0.2}, {0, 0.1, 0}, Vec3::UnitX());
  const auto scene = test::snapshotOf(std::move(model));
  const ProxySettings settings = adhesive(1);
  ProxyState state = startProxy(*scene, settings, {0.01, 0.01, 0});
  for (int i = 0; i < 5; ++i) tick(state, *scene, settings, {0.5 * kRadius, 0.5 * kRadius, 0});
  ASSERT_EQ(state.adhering.size(), 2U);
  tick(state, *scene, settings, {kRadius + 0.9e-3, kRadius + 0.9e-3, 0});
  EXPECT_NEAR((state.position - Vec3(kRadius, kRadius, 0)).norm(), 0, 1e-9);
  for (int i = 0; i < 3; ++i) tick(state, *scene, settings, {kRadius + 1.1e-3, kRadius + 0.9e-3, 0});
  EXPECT_NEAR((state.position - Vec3(kRadius + 1.1e-3, kRadius, 0)).norm(), 0, 1e-9);
}

// Whatever the finger does: no energy comes from it, and nothing is entered.
TEST(Adhesion, NeverAddsEnergyAndNeverEnters) {
  Model model = test::floorModel();
  test::addRectangle(model, {0.02, 0, 0.1}, {0, 0, -0.2}, {0, 0.05, 0}, -Vec3::UnitX());
  test::addRectangle(model, {-0.02, 0.004, 0.1}, {0.02, 0.003, 0}, {0, 0, -0.2}, Vec3::UnitY());
  const auto scene = test::snapshotOf(std::move(model));
  std::mt19937 random(5);
  std::normal_distribution<double> jump(0, 4e-4);
  for (int run = 0; run < test::cases(20); ++run) {
    ProxySettings settings = adhesive(std::uniform_real_distribution<double>(0, 3)(random));
    if (run % 2 == 0) settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.6;
    if (run % 3 == 0) settings.surfaces.stiffness = 0.4;
    ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
    Vec3 finger(0, 0.002, 0);
    for (int i = 0; i < 2000; ++i) {
      finger = (finger + Vec3(jump(random), jump(random), jump(random))).cwiseMin(0.03).cwiseMax(-0.03);
      const double before = (state.position - finger).norm();
      tick(state, *scene, settings, finger);
      ASSERT_LE((state.position - finger).norm(), before + kRounding_m);
      ASSERT_GE(judge::clearance(*scene, state.position, 1), kRadius * (1 - 1e-6));
    }
    EXPECT_EQ(state.ledger.injected_J, 0);
  }
}

TEST(Adhesion, IsRealTimeSafe) {
  const auto scene = test::snapshotOf(test::floorModel());
  const ProxySettings settings = adhesive(1);
  ProxyState state = restingOn(*scene, settings);
  const SceneAt now(*scene);
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) tick(state, now, settings, {1e-4 * (i % 7), kRadius + 1.2e-3 * std::sin(0.1 * i), 0});
}

}  // namespace
}  // namespace hl::test_adhesion
