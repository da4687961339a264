// Pre-sliding against a judge in one dimension, and what it promises in two: forces without jumps, energy that is given
// back and no more.
#include "proxy/presliding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "effect_scenes.h"
#include "judge.h"
#include "proxy/proxy.h"

namespace hl::test_presliding {
namespace {

constexpr double kK = 1000;  // N/m
constexpr double kRadius = 0.001;

struct Material {
  double mu_s, mu_d, spring_N_m;
};

ProxySettings settingsOf(const Material& material, LedgerMode ledger = LedgerMode::kStrict) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.spring_N_m = kK;
  settings.surfaces.static_friction = material.mu_s;
  settings.surfaces.dynamic_friction = material.mu_d;
  settings.surfaces.presliding_N_m = material.spring_N_m;
  settings.ledger = ledger;
  return settings;
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Material drawMaterial(std::mt19937_64& random) {
  const double mu_d = uniform(random, 0.1, 1.5);
  return {mu_d * (random() % 2 == 0 ? 1 : uniform(random, 1, 2)), mu_d, std::pow(10, uniform(random, 2, 4.5))};
}

// A point on a line that is pulled by a spring of 1 N/m (lengths are forces), held by springs of r in series with a
// slider: its way is elastic while the springs carry less than friction does, and plastic beyond.
struct Slider {
  double ratio, static_m, dynamic_m;
  double at = 0, stretch = 0;
  int rested = 1000;  // ticks since the last slip

  double pullBy(double finger) {
    const double pull = finger - at;
    const double crept = (pull - ratio * stretch) / (1 + ratio);
    const bool stuck = rested >= 20;
    constexpr double kRounding = 1e-12;
    if (std::abs(pull - crept) <= (stuck ? static_m : dynamic_m) * (1 + kRounding)) {
      at += crept;
      stretch += crept;
      ++rested;
    } else {
      at = finger - std::copysign(dynamic_m, pull);
      stretch = std::copysign(dynamic_m / ratio, pull);
      rested = 0;
    }
    return finger - at;
  }
};

TEST(Presliding, FollowsAnElasticSpringAndASliderInSeries) {
  const auto floor = test::snapshotOf(test::floorModel());
  const double rest_m = Tolerances::of(kRadius, floor->extent).rest;  // shorter steps are not made
  std::mt19937_64 random(1);
  for (int run = 0; run < 60; ++run) {
    const Material material = drawMaterial(random);
    const double depth = uniform(random, 0.0005, 0.003), y = kRadius - depth;
    const ProxySettings settings = settingsOf(material);
    ProxyState state = startProxy(*floor, settings, {0, 0.01, 0});
    tick(state, *floor, settings, {0, y, 0});
    Slider judge{material.spring_N_m / kK, material.mu_s * depth, material.mu_d * depth};
    double x = 0, velocity = 0;
    for (int i = 0; i < 1500; ++i) {
      velocity = std::clamp(velocity + uniform(random, -1, 1) * 2e-5, -3e-4, 3e-4);
      if (random() % 100 == 0) velocity = 0;
      x = std::clamp(x + velocity, -0.05, 0.05);
      const TickReport report = tick(state, *floor, settings, {x, y, 0});
      ASSERT_NEAR(x - report.target.x(), judge.pullBy(x), (1 + judge.ratio) * rest_m + 1e-12) << run << ' ' << i;
    }
  }
}

// A hand that moves in all directions, also off the surface and on to it.
struct Hand {
  std::mt19937_64 random;
  Vec3 at, velocity = Vec3::Zero();

  Hand(std::uint64_t seed, const Vec3& start) : random(seed), at(start) {}
  Vec3 move(const Box& within) {
    for (int i = 0; i < 3; ++i) {
      velocity[i] = std::clamp(velocity[i] + uniform(random, -1, 1) * 3e-5, -2e-4, 2e-4);
      if (at[i] < within.min[i]) velocity[i] = std::abs(velocity[i]);
      if (at[i] > within.max[i]) velocity[i] = -std::abs(velocity[i]);
    }
    return at += velocity;
  }
};

// A finger that moves by dx changes the normal force by K |dx| at most, and the friction that it carries by mu times
// that, where static friction is dynamic friction.
TEST(Presliding, NeitherTurnsNorRestsMakeTheForceJump) {
  const auto floor = test::snapshotOf(test::floorModel());
  std::mt19937_64 random(2);
  for (std::uint64_t run = 0; run < 60; ++run) {
    Material material = drawMaterial(random);
    material.mu_s = material.mu_d;
    const ProxySettings settings = settingsOf(material);
    Hand hand(run, {0, 0.005, 0});
    ProxyState state = startProxy(*floor, settings, hand.at);
    Vec3 force = Vec3::Zero();
    for (int i = 0; i < 2000; ++i) {
      const Vec3 before = hand.at;
      const Vec3 finger = hand.move({{-0.05, kRadius - 0.003, -0.05}, {0.05, kRadius + 0.0005, 0.05}});
      const TickReport report = tick(state, *floor, settings, finger);
      const Vec3 now = kK * (report.target - finger);
      ASSERT_LE((now - force).norm(), kK * (1 + material.mu_d) * (finger - before).norm() + 1e-6) << run << ' ' << i;
      ASSERT_EQ(report.contacts.empty(), now.norm() < 1e-9) << run << ' ' << i;
      force = now;
    }
  }
}

// Where nothing is shaded or textured no energy comes from anywhere: the strict ledger has nothing to refuse.
TEST(Presliding, GivesBackWhatItHasStoredAndNoMore) {
  std::mt19937_64 random(3);
  for (std::uint64_t run = 0; run < 40; ++run) {
    const double waves = uniform(random, 100, 400), height = uniform(random, 0, 1e-3);
    Model model = judge::grid(16, 16, [&](double u, double v) {
      const double x = 0.06 * (u - 0.5), z = 0.06 * (0.5 - v);
      return Vec3(x, height * std::cos(waves * x) * std::cos(waves * z), z);
    });
    const auto scene = test::snapshotOf(std::move(model));
    const ProxySettings settings = settingsOf(drawMaterial(random));
    Hand hand(run, {0, 0.006, 0});
    ProxyState state = startProxy(*scene, settings, hand.at);
    for (int i = 0; i < 1500; ++i) {
      const Vec3 finger = hand.move({{-0.02, kRadius - 0.003, -0.02}, {0.02, kRadius + 0.0015, 0.02}});
      const TickReport report = tick(state, *scene, settings, finger);
      ASSERT_LE(report.injected_J, 1e-12) << run << ' ' << i;
      ASSERT_NE(report.ending, Ending::kNoEnergy) << run << ' ' << i;
    }
    EXPECT_LE(state.ledger.injected_J, 1e-12) << run;
  }
}

TEST(Presliding, SpringsOfOtherContactsStoreNoMore) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 1000; ++i) {
    const PreslidingSprings before{Vec3::Random(), uniform(random, 0, 1000)};
    const PreslidingSprings after = before.on(uniform(random, 0, 1000));
    EXPECT_LE(after.energy_J(1), before.energy_J(1) * (1 + 1e-12));
    EXPECT_LE(after.stiffness_N_m * after.stretch_m.norm(),
              before.stiffness_N_m * before.stretch_m.norm() * (1 + 1e-12));
  }
  EXPECT_EQ(PreslidingSprings{}.on(500).stretch_m, Vec3(Vec3::Zero()));
}

// The user may set the spring to nothing while the finger is in contact, and give it back.
TEST(Presliding, WithoutASpringTheProxyStaysOutside) {
  const auto scene = test::snapshotOf(test::floorModel());
  for (const double spring_N_m : {0.0, 1e-300, 1e-12}) {
    ProxySettings settings = settingsOf({0.8, 0.5, 2000});
    ProxyState state = startProxy(*scene, settings, {0, 0.01, 0});
    const auto go = [&](double from, double to) {
      for (int i = 0; i < 100; ++i) {
        tick(state, *scene, settings, {from + (to - from) * i / 100, -0.004, 1e-4 * i});
        ASSERT_TRUE(state.position.allFinite());
        ASSERT_GE(state.position.y(), 0.999 * kRadius) << spring_N_m;
      }
    };
    go(0, 0.004);
    settings.spring_N_m = spring_N_m;
    go(0.004, 0.02);
    settings.spring_N_m = kK;
    go(0.02, 0.03);
  }
}

}  // namespace
}  // namespace hl::test_presliding
