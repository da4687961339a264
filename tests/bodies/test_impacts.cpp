// Impacts of several bodies at once; R29 is that of docs/bodies.md.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "draws.h"
#include "test_worlds.h"

namespace hl::test_impacts {
namespace {

using namespace test;

TEST(Impacts, R29OfNewtonsCradleOneBallLeaves) {
  for (const bool hits_from_the_right : {false, true}) {
    World world;
    world.gravity_m_s2.setZero();
    std::vector<Pose> poses;
    const double sign = hits_from_the_right ? -1 : 1;
    for (std::uint64_t i = 0; i < 3; ++i) {
      world.bodies.push_back(ball(i + 1, 0.1, 0.01, 0, 1));
      poses.push_back(placeAt(Vec3(sign * (0.02 * static_cast<double>(i) - (i == 0 ? 0.0103 : 0)), 0, 0)));
    }
    Playground play(std::move(world), poses);
    play.state.bodies[0].velocity = Vec3(sign * 0.5, 0, 0);
    const double begin_J = play.energy_J();
    for (int i = 0; i < 200; ++i) {
      play.step();
      EXPECT_LE(play.energy_J(), begin_J * (1 + 1e-12));
    }
    EXPECT_LT(std::abs(play.state.bodies[0].velocity.x()), 0.5e-3);
    EXPECT_LT(std::abs(play.state.bodies[1].velocity.x()), 0.5e-3);
    EXPECT_NEAR(play.state.bodies[2].velocity.x(), sign * 0.5, 0.5e-3);
  }
}

// All corners of a face meet the floor together: it goes up by e^2 of its height, and neither turns nor goes aside.
TEST(Impacts, ABoxThatFallsFlatGoesUpFlat) {
  constexpr double kHeight_m = 0.1, kHalf_m = 0.02;
  for (const double restitution : {0.1, 0.5, 0.8, 1.0}) {
    for (const double friction : {0.0, 0.5}) {
      World world;
      world.fixed = floorScene();
      world.fixed_surface = {friction, friction, restitution};
      world.bodies.push_back(block(1, 0.1, Vec3::Constant(kHalf_m), friction));
      world.bodies.back().surface.restitution = restitution;
      Playground play(std::move(world), {placeAt(Vec3(0, kHalf_m + kHeight_m, 0))});
      double highest_m = 0;
      bool fallen = false;
      for (int i = 0; i < 600; ++i) {
        play.step();
        const BodyState& body = play.state.bodies[0];
        fallen = fallen || body.velocity.y() > 0;
        if (fallen) highest_m = std::max(highest_m, body.centre.y() - kHalf_m);
        ASSERT_LT(body.spin.norm(), 1e-6) << restitution << " " << friction << " " << i;
        ASSERT_LT(std::hypot(body.centre.x(), body.centre.z()), 1e-9);
      }
      EXPECT_NEAR(highest_m, restitution * restitution * kHeight_m, 0.002 * kHeight_m) << restitution;
    }
  }
}

// A ball goes up by e^2 of what it fell from, whenever in a step it meets the floor: never by more, and by less only
// for a part of the way of a step.
TEST(Impacts, ABallNeverGainsByABounce) {
  constexpr double kRadius_m = 0.01, kFall_m_s = 9.81e-3;  // by gravity in a step
  Draws draws(7);
  for (int run = 0; run < 40; ++run) {
    const double restitution = run % 2 == 0 ? 1 : draws.between(0.3, 1), height_m = draws.between(1e-4, 5e-3);
    World world;
    world.fixed = floorScene();
    world.fixed_surface = {0, 0, restitution};
    world.bodies.push_back(ball(1, 0.1, kRadius_m, 0, restitution));
    Playground play(std::move(world), {placeAt(Vec3(0, kRadius_m + height_m, 0))});
    const BodyState& body = play.state.bodies[0];
    const auto energy = [&] {
      return body.velocity.y() * body.velocity.y() / 2 + 9.81 * (body.centre.y() - kRadius_m);
    };
    double before = energy(), last_m_s = 0;
    for (int i = 0; i < 500; ++i) {
      play.step();
      const double now_m_s = body.velocity.y();
      if (last_m_s < -0.04 && now_m_s > 0) {
        const double kept = energy() / (restitution * restitution * before);
        EXPECT_LE(kept, 1 + 1e-9) << run << " " << i << " " << height_m;
        EXPECT_GE(kept, 1 + 0.3 * kFall_m_s / last_m_s) << run << " " << i << " " << height_m;
      }
      if (now_m_s < 0 || last_m_s < 0) before = energy();
      last_m_s = now_m_s;
    }
  }
}

TEST(Impacts, R29DominoesFallOneAfterAnother) {
  World world;
  world.fixed = floorScene();
  world.fixed_surface = {0.5, 0.5, 0};
  std::vector<Pose> poses;
  for (std::uint64_t i = 0; i < 8; ++i) {
    world.bodies.push_back(block(i + 1, 0.02, Vec3(0.004, 0.025, 0.012), 0.5));
    poses.push_back(placeAt(Vec3(0.025 * static_cast<double>(i), 0.025, 0)));
  }
  Playground play(std::move(world), poses);
  play.state.bodies[0].spin = Vec3(0, 0, -5);  // about its lower edge
  play.state.bodies[0].velocity = Vec3(0.125, 0.02, 0);
  const double begin_J = play.energy_J();
  for (int i = 0; i < 1500; ++i) {
    play.step();
    ASSERT_LE(play.energy_J(), begin_J + 1e-9) << i;
  }
  for (const BodyState& body : play.state.bodies) {
    EXPECT_LT((body.turned * Vec3::UnitY()).y(), 0.9);
    EXPECT_LT(body.velocity.norm(), 0.1);
  }
}

// Rods that fall on an end with much friction: Newton's restitution with the friction of that impact would add energy.
TEST(Impacts, NoImpactWithFrictionAddsKineticEnergy) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int bounced = 0;
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    World world;
    world.gravity_m_s2.setZero();
    world.fixed = floorScene();
    world.fixed_surface = {1, 1, 1};
    world.bodies = {block(1, 0.1, Vec3(0.005, 0.05, 0.005), 1)};
    world.bodies[0].surface.restitution = 1;
    const Mat3 turn =
        Eigen::AngleAxisd(1.2 * uniform(random), Vec3(uniform(random), 0, 1).normalized()).toRotationMatrix();
    Playground play(std::move(world), {placeAt(Vec3(0, 0.06, 0), turn)});
    play.state.bodies[0].velocity = Vec3(uniform(random), -1, uniform(random));
    play.state.bodies[0].spin = 20 * Vec3(uniform(random), uniform(random), uniform(random));
    double last_J = play.energy_J();
    for (int step = 0; step < 100; ++step) {
      const double approach = play.state.bodies[0].velocity.y();
      play.step();
      bounced += approach < 0 && play.state.bodies[0].velocity.y() > 0 ? 1 : 0;
      worst = std::max(worst, play.energy_J() / last_J);
      last_J = play.energy_J();
    }
  }
  EXPECT_GT(bounced, 100);
  EXPECT_LT(worst, 1.06);  // what the turn in the step of an impact adds; without the rule it is 1.5
}

// Needles, rods and boxes that fall on a floor with a spin, without and with friction, of any restitution.
TEST(Impacts, WhatBouncesOnAFloorGainsNoEnergy) {
  Draws draws(2);
  for (int run = 0; run < 60; ++run) {
    const double thin = std::pow(10, draws.between(-4.3, -2));
    World world;
    world.fixed = floorScene();
    Body body = block(1, 0.1, Vec3(thin, draws.between(1, 1.5) * thin, 0.015), run % 3 == 0 ? 0 : 0.4);
    body.surface.restitution = run % 2 == 0 ? 1 : draws.between(0, 1);
    world.bodies = {body};
    Playground play(std::move(world),
                    {{Eigen::AngleAxisd(draws.between(0, 3), draws.direction()).toRotationMatrix(), Vec3(0, 0.1, 0)}});
    play.state.bodies[0].velocity = Vec3(0, -2, 0);
    play.state.bodies[0].spin = draws.between(0, 50) * draws.direction();
    const double begun_J = play.energy_J();
    for (int step = 0; step < 1000; ++step) {
      play.step();
      ASSERT_LT(play.energy_J(), 1.01 * begun_J) << "run " << run << ", thin " << thin << ", step " << step;
    }
  }
}

}  // namespace
}  // namespace hl::test_impacts
