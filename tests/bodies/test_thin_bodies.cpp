// Thin bodies: nothing passes through what it falls on, though in one step it goes many times as far as it is thick.
#include <gtest/gtest.h>

#include <cmath>

#include "draws.h"
#include "test_worlds.h"

namespace hl::test_thin_bodies {
namespace {

using namespace test;

constexpr double kThinnest_m = 2e-6;

// m; of the lowest corner of the body.
double lowestOf(const Playground& play, std::size_t body) {
  const BodyState& state = play.state.bodies[body];
  double lowest = state.centre.y();
  for (const Vec3& vertex : play.world->bodies[body].shape.parts.front().vertices)
    lowest = std::min(lowest, (state.centre + state.turned * vertex).y());
  return lowest;
}

void expectThatItComesToRest(double thick_m, const Mat3& turned, const Vec3& velocity) {
  World world;
  world.fixed = floorScene();
  world.bodies = {block(1, 1e-3, Vec3(0.02, thick_m / 2, 0.02), 0.4)};
  Playground play(std::move(world), {placeAt(Vec3(0.003, 0.03, 0.011), turned)});
  play.state.bodies[0].velocity = velocity;
  for (int i = 0; i < 1000; ++i) {
    play.step();
    ASSERT_GT(lowestOf(play, 0), -2e-5) << thick_m << " m, " << velocity.transpose() << " m/s, step " << i;
  }
  EXPECT_NEAR(play.state.bodies[0].centre.y(), thick_m / 2, 1e-6) << thick_m;
}

TEST(ThinBodies, APlateThatFallsFlatLiesOnTheFloor) {
  for (const double thick_m : {1e-3, 1e-4, 2e-5, kThinnest_m}) {
    for (const double speed : {0.0, 0.1, 0.3, 1.0, 2.0, 5.0})
      expectThatItComesToRest(thick_m, Mat3::Identity(), Vec3(0, -speed, 0));
  }
}

TEST(ThinBodies, APlateThatFallsInAnyPoseLiesOnTheFloor) {
  Draws draws(1);
  for (int i = 0; i < 40; ++i) {
    const double thick_m = std::exp(draws.between(std::log(kThinnest_m), std::log(1e-3)));
    const Mat3 turned = Eigen::AngleAxisd(draws.between(0, 1), draws.direction()).toRotationMatrix();
    expectThatItComesToRest(thick_m, turned, Vec3(draws.between(-1, 1), draws.between(-5, 0), 0));
  }
}

TEST(ThinBodies, PlatesThatFallOnEachOtherStayInOrder) {
  World world;
  world.fixed = floorScene();
  std::vector<Pose> poses;
  for (int i = 0; i < 5; ++i) {
    world.bodies.push_back(block(static_cast<std::uint64_t>(i) + 1, 1e-3, Vec3(0.02, 3e-5, 0.02), 0.4));
    poses.push_back(placeAt(Vec3(0.001 * i, 0.001 * (i + 1), 0)));
  }
  Playground play(std::move(world), poses);
  play.steps(1000);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(play.state.bodies[static_cast<std::size_t>(i)].centre.y(), 3e-5 + 6e-5 * i, 1e-5) << i;
}

// The way of a step is 1 mm, and so is the gap to the edge.
TEST(ThinBodies, APlateFallsFreelyBesideAnEdge) {
  World world;
  world.fixed = floorScene(0.05);
  world.bodies = {block(1, 1e-3, Vec3(0.02, 3e-5, 0.02), 0.4)};
  Playground play(std::move(world), {placeAt(Vec3(0.071, 0.02, 0))});
  const double speed = 1, seconds = 0.05;
  play.state.bodies[0].velocity = Vec3(0, -speed, 0);
  play.steps(50);
  EXPECT_NEAR(play.state.bodies[0].centre.y(), 0.02 - speed * seconds - kGravity * seconds * seconds / 2, 1e-12);
}

TEST(ThinBodies, NoneLeavesAClosedRoom) {
  constexpr double kRoom_m = 0.1;
  for (int seed = 0; seed < 20; ++seed) {
    Draws draws(static_cast<std::uint64_t>(seed));
    const double half_m = std::exp(draws.between(std::log(1e-5), std::log(5e-4)));
    const BodySurface surface{0.5, 0.4, 0.3};
    World world;
    world.fixed = makeSnapshot(boxModel(Vec3::Constant(kRoom_m)));
    world.bodies = {block(1, 1e-3, Vec3(0.02, half_m, 0.02), 0.4),
                    {2, massOfCylinder(1e-2, half_m, 0.015), cylinderShape(half_m, 0.015), surface},
                    {3, massOfBall(1e-4, half_m), ballShape(half_m), surface},
                    block(4, 1e-2, Vec3(half_m, 0.01, 0.02), 0.4)};
    std::vector<Pose> poses;
    for (int i = 0; i < 4; ++i) {
      const Mat3 turned = Eigen::AngleAxisd(draws.between(0, 3), draws.direction()).toRotationMatrix();
      poses.push_back(placeAt(Vec3(draws.between(-0.05, 0.05), -0.06 + 0.03 * i, draws.between(-0.05, 0.05)), turned));
    }
    Playground play(std::move(world), poses);
    for (BodyState& body : play.state.bodies) {
      body.velocity = draws.between(0, 5) * draws.direction();
      body.spin = draws.between(0, 50) * draws.direction();
    }
    for (int i = 0; i < 1000; ++i) {
      play.step();
      for (const BodyState& body : play.state.bodies)
        ASSERT_LT(body.centre.cwiseAbs().maxCoeff(), kRoom_m) << seed << " step " << i;
    }
  }
}

}  // namespace
}  // namespace hl::test_thin_bodies
