// Friction: Coulomb, static and viscous, against closed forms on floors and in grooves (science 1.3 and fault 7).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "effect_scenes.h"
#include "proxy/friction.h"
#include "proxy/proxy.h"

namespace hl::test_friction {
namespace {

constexpr double kK = 1800;       // N/m
constexpr double kDepth = 0.001;  // m: 1.8 N on the floor
constexpr double kRadius = 0.001;

ProxySettings settingsOf(double mu_s, double mu_d, double viscosity = 0) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.surfaces.static_friction = mu_s;
  settings.surfaces.dynamic_friction = mu_d;
  settings.surfaces.viscosity_Ns_m = viscosity;
  settings.ledger = LedgerMode::kStrict;
  return settings;
}

struct Steady {
  double mean = 0, ripple = 0;
};

// Presses `depth` into the floor and drags along x at `speed`; the tangential force once it is steady. The encoder
// counts in steps of `count` metres (0: exact).
Steady drag(const Snapshot& scene, const ProxySettings& settings, double depth, double speed, double count = 0) {
  ProxyState state = startProxy(scene, settings, {-0.08, 0.01, 0});
  const double y = kRadius - depth;
  tick(state, scene, settings, {-0.08, y, 0});
  // Past breakaway, and past the transient of viscosity, whose time constant is b / K.
  const double softest_N_m =
      kK * settings.surfaces.stiffness.value_or(1) / (1 + kK * settings.surfaces.compliance_m_N.value_or(0));
  const double start = 0.004 + speed * (0.02 + 10 * settings.surfaces.viscosity_Ns_m.value_or(0) / softest_N_m);
  double sum = 0, least = 1e9, most = 0;
  int n = 0;
  for (double x = 0; x < 0.15; x += speed * settings.period_s) {
    const double seen = count > 0 ? count * std::floor(x / count) : x;
    const Vec3 finger(-0.08 + seen, y, 0);
    const TickReport report = tick(state, scene, settings, finger);
    if (x < start) continue;
    const double force = kK * (finger.x() - report.target.x());
    sum += force;
    least = std::min(least, force);
    most = std::max(most, force);
    ++n;
  }
  return {sum / n, most - least};
}

// C32: mu_d f_n + b u, within 0.1 %, ripple below 1 %.
TEST(Friction, SteadyDragIsCoulombPlusViscous) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double b : {0.0, 2.0, 20.0}) {
    for (const double u : {0.01, 0.05, 0.2}) {
      const Steady steady = drag(*scene, settingsOf(0.6, 0.4, b), kDepth, u);
      const double expected = 0.4 * kK * kDepth + b * u;
      EXPECT_NEAR(steady.mean, expected, 1e-3 * expected) << "b " << b << " u " << u;
      EXPECT_LT(steady.ripple, 0.01 * expected) << "b " << b << " u " << u;
    }
  }
}

// The same over the seams of a finely tessellated floor: the drag must not depend on the triangles.
// A soft surface, or one that yields in series, drags the hand by the same newtons for each m/s.
TEST(Friction, ViscosityActsOnTheHandHoweverSoftTheSurfaceIs) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double stiffness : {1.0, 0.5, 0.1}) {
    for (const double compliance_m_N : {0.0, 1e-3}) {
      for (const double b : {0.5, 5.0}) {
        ProxySettings settings = settingsOf(0, 0, b);
        settings.surfaces.stiffness = stiffness;
        settings.surfaces.compliance_m_N = compliance_m_N;
        EXPECT_NEAR(drag(*scene, settings, kDepth, 0.02).mean, b * 0.02, 1e-3 * b * 0.02)
            << stiffness << " " << compliance_m_N << " " << b;
      }
    }
  }
}

// sigma_0 in series with the spring as it is felt, K s.
TEST(Friction, PreslidingSpringsAreThoseOfTheHand) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double stiffness : {1.0, 0.25}) {
    ProxySettings settings = settingsOf(5, 5);
    settings.surfaces.stiffness = stiffness;
    settings.surfaces.presliding_N_m = 500;
    settings.ledger = LedgerMode::kTank;
    ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
    const double y = kRadius - kDepth, x = 1e-4, felt_N_m = kK * stiffness;
    for (int i = 0; i < 3; ++i) tick(state, *scene, settings, {0, y, 0});
    for (int i = 0; i < 30; ++i) tick(state, *scene, settings, {x, y, 0});
    EXPECT_NEAR(state.position.x(), x * felt_N_m / (felt_N_m + 500), 1e-10) << stiffness;
  }
}

TEST(Friction, SteadyDragDoesNotFeelTheTessellation) {
  Model model;
  for (int i = 0; i < 700; ++i) {
    const double x0 = -0.1 + 0.2 * i / 700, x1 = -0.1 + 0.2 * (i + 1) / 700;
    test::addRectangle(model, {x0, 0, 0.1}, {x1 - x0, 0, 0}, {0, 0, -0.2}, Vec3::UnitY());
  }
  const auto scene = makeSnapshot(std::move(model), HierarchyKind::kBvh);
  const Steady steady = drag(*scene, settingsOf(0.6, 0.4, 2), kDepth, 0.2);
  const double expected = 0.4 * kK * kDepth + 2 * 0.2;
  EXPECT_NEAR(steady.mean, expected, 1e-3 * expected);
  EXPECT_LT(steady.ripple, 0.01 * expected);
}

// C33: no velocity is estimated, so counts of 30 um change the mean by less than 1 %.
TEST(Friction, EncoderCountsDoNotChangeTheMean) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double u : {0.01, 0.05, 0.2}) {
    const Steady steady = drag(*scene, settingsOf(0.6, 0.4), kDepth, u, 30e-6);
    EXPECT_NEAR(steady.mean, 0.4 * kK * kDepth, 0.01 * 0.4 * kK * kDepth) << u;
  }
}

// C30: breaks away at atan(mu_s).
TEST(Friction, BreaksAwayAtTheAngleOfStaticFriction) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double mu : {0.1, 0.6, 1.3}) {
    const ProxySettings settings = settingsOf(mu, 0.5 * mu);
    ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
    tick(state, *scene, settings, {0, kRadius - kDepth, 0});
    const double stuck_at = state.position.x();
    double angle = 0;
    while (state.position.x() == stuck_at && angle < M_PI / 2) {
      angle += 1e-4 * std::atan(mu);
      tick(state, *scene, settings, {kDepth * std::tan(angle), kRadius - kDepth, 0});
    }
    EXPECT_NEAR(angle, std::atan(mu), 1e-3 * std::atan(mu)) << mu;
  }
}

// C30: not one bit of drift in a million ticks of encoder noise inside the cone.
TEST(Friction, NoDriftInsideTheCone) {
  const auto scene = test::snapshotOf(test::floorModel());
  const ProxySettings settings = settingsOf(0.6, 0.4);
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  tick(state, *scene, settings, {0, kRadius - kDepth, 0});
  const Vec3 start = state.position;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> count(-1, 1);
  for (int i = 0; i < 1'000'000; ++i) {
    const Vec3 noise(30e-6 * count(random), 30e-6 * count(random), 30e-6 * count(random));
    tick(state, *scene, settings, Vec3(0.3e-3, kRadius - kDepth, 0.2e-3) + noise);
  }
  EXPECT_EQ(state.position, start);
}

// C31 and fault 7: in a groove each wall carries f / (2 sin(opening / 2)), so the drag is mu f / sin(opening / 2).
TEST(Friction, GrooveDragsWithTheTrueWallForces) {
  for (const double degrees : {60.0, 30.0}) {
    const double opening = degrees * M_PI / 180;
    const auto scene = test::groove(opening);
    const ProxySettings settings = settingsOf(0.3, 0.3);
    const double rest = kRadius / std::sin(opening / 2);  // height of the proxy that touches both walls
    ProxyState state = startProxy(*scene, settings, {-0.08, 0.06, 0});
    tick(state, *scene, settings, {-0.08, rest - kDepth, 0});
    Vec3 force = Vec3::Zero();
    for (double x = 0; x < 0.02; x += 1e-4) {
      const Vec3 finger(-0.08 + x, rest - kDepth, 0);
      const TickReport report = tick(state, *scene, settings, finger);
      force = kK * (report.target - finger);
      ASSERT_EQ(report.contacts.size(), 2u);
      for (const ProxyContact& contact : report.contacts)
        EXPECT_NEAR(kK * contact.multiplier_m, kK * kDepth / (2 * std::sin(opening / 2)), 1e-6);
    }
    const double expected = 0.3 * kK * kDepth / std::sin(opening / 2);
    EXPECT_NEAR(-force.x(), expected, 1e-3 * expected) << degrees;
  }
}

// The slip of a whole way is the sum of the slips of its parts: a tick that stops at a seam and goes on loses nothing.
TEST(Friction, AnInterruptedSlipGoesOnAsIfItHadNotBeen) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 10'000; ++i) {
    SlipResistance resistance;
    const double dynamic = 1e-3 * u(random);
    resistance.contacts.push({dynamic * (1 + u(random)), dynamic, 0});
    resistance.viscous = 10 * u(random);
    const double pull = 3e-3 * u(random);
    const double whole = slipLength(resistance, pull, {});
    const double first = whole * u(random);
    const Slip before{first, resistance.viscous * first};
    EXPECT_NEAR(first + slipLength(resistance, pull - first, before), whole, 1e-15);
  }
}

// Stribeck: a slide goes on at the resistance of its own speed, mu_d + (mu_s - mu_d) exp(-(v / v_s)^2). Where the curve
// falls faster than the spring can follow, slower than about the Stribeck speed, any slide is stick-slip instead.
TEST(Friction, StribeckCurveIsFollowedWhileSliding) {
  Model model = test::floorModel();
  model.materials[0].static_friction = 0.6;
  model.materials[0].dynamic_friction = 0.4;
  model.materials[0].stribeck_m_s = 0.05;
  const auto scene = test::snapshotOf(std::move(model));
  ProxySettings settings = settingsOf(0, 0);
  settings.surfaces = {};
  for (const double speed : {0.1, 0.12, 0.2}) {
    const double ratio = speed / 0.05;
    const double expected = kK * kDepth * (0.4 + 0.2 * std::exp(-ratio * ratio));
    EXPECT_NEAR(drag(*scene, settings, kDepth, speed).mean, expected, 1e-3 * expected) << speed;
  }
}

// Pre-sliding springs sigma_0 in series with the servo's K: the stuck proxy follows K / (K + sigma_0) of the pull, back
// to the bit of rounding when the pull goes, breaks away at mu_s and slides with mu_d all the same.
TEST(Friction, PreslidingCreepsLikeASpringAndBreaksAwayAtTheSameForce) {
  Model model = test::floorModel();
  model.materials[0].static_friction = 0.6;
  model.materials[0].dynamic_friction = 0.4;
  model.materials[0].presliding_N_m = 4 * kK;
  const auto scene = test::snapshotOf(std::move(model));
  ProxySettings settings = settingsOf(0, 0);
  settings.surfaces = {};
  settings.ledger = LedgerMode::kTank;
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  const double y = kRadius - kDepth;
  tick(state, *scene, settings, {0, y, 0});
  const double breakaway = 1.25 * 0.6 * kDepth;  // of the finger: |d| = 4/5 of its way
  for (const double x : {0.2, 0.9, 0.5, -0.7, 0.0, 0.99}) {
    const TickReport report = tick(state, *scene, settings, {x * breakaway, y, 0});
    EXPECT_NEAR(state.position.x(), 0.2 * x * breakaway, 1e-12) << x;
    EXPECT_NEAR(x * breakaway - report.target.x(), 0.8 * x * breakaway, 1e-12) << x;
  }
  tick(state, *scene, settings, {1.01 * breakaway, y, 0});
  EXPECT_NEAR(1.01 * breakaway - state.position.x(), 0.4 * kDepth, 1e-9) << "slides at mu_d";
  EXPECT_LE(state.ledger.injected_J, kTankStart_J);
  const Steady steady = drag(*scene, settings, kDepth, 0.05);
  EXPECT_NEAR(steady.mean, 0.4 * kK * kDepth, 1e-3 * 0.4 * kK * kDepth);
}

// In one tick from the floor to the wall: the springs still pull as on the floor, straight into the wall.
TEST(Friction, PreSlidingNeverPullsTheProxyIntoAnotherSurface) {
  Model model = test::floorModel();
  test::addRectangle(model, {0.02, 0, 0.1}, {0, 0.1, 0}, {0, 0, -0.2}, -Vec3::UnitX());
  model.materials[0].static_friction = 0.6;
  model.materials[0].presliding_N_m = 4 * kK;
  const auto scene = test::snapshotOf(std::move(model));
  ProxySettings settings = settingsOf(0, 0);
  settings.surfaces = {};
  ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
  for (const double x : {0.0, -0.5 * kDepth}) tick(state, *scene, settings, {x, kRadius - kDepth, 0});
  EXPECT_LT(state.sticking.springs.stretch_m.x(), -0.05 * kDepth);
  tick(state, *scene, settings, {0.02, 0.01, 0});
  EXPECT_LE(state.position.x(), 0.02 - kRadius);
}

// C10 with friction: no tick leaves the proxy farther from the finger than it was.
TEST(Friction, NeverAddsEnergy) {
  const auto scene = test::groove(1.2);
  std::mt19937 random(3);
  std::normal_distribution<double> jump(0, 2e-3);
  const ProxySettings settings = settingsOf(0.5, 0.3, 5);
  ProxyState state = startProxy(*scene, settings, {0, 0.05, 0});
  Vec3 finger(0, 0.05, 0);
  for (int i = 0; i < 50'000; ++i) {
    finger = (finger + Vec3(jump(random), jump(random), jump(random))).cwiseMin(0.05).cwiseMax(-0.05);
    const double before = (state.position - finger).norm();
    tick(state, *scene, settings, finger);
    ASSERT_LE((state.position - finger).norm(), before + 1e-12) << i;
  }
}

}  // namespace
}  // namespace hl::test_friction
