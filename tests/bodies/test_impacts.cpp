// Impacts of several bodies at once; R29 is that of docs/bodies.md.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "test_worlds.h"

namespace hl {
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

}  // namespace
}  // namespace hl
