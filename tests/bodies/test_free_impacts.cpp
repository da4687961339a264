// Free impacts: two bodies that hit each other, and nothing else, keep their momentum, however fast they are.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "bodies/convex_hull.h"
#include "draws.h"
#include "test_worlds.h"

namespace hl::test_free_impacts {
namespace {

using namespace test;

struct ImpactDraws : Draws {
  using Draws::Draws;
  Body body(std::uint64_t key, double size) {
    const double mass_kg = std::exp(between(std::log(1e-3), std::log(1.0)));
    const BodySurface surface{between(0, 1), between(0, 1), between(0, 1)};
    const Vec3 half = size * Vec3(between(0.2, 1), between(0.2, 1), between(0.2, 1));
    switch (random() % 4) {
      case 0:
        return {key, massOfBox(mass_kg, half), boxShape(half), surface};
      case 1:
        return {key, massOfCylinder(mass_kg, half.x(), half.y()), cylinderShape(half.x(), half.y()), surface};
      case 2:
        return {key, massOfCapsule(mass_kg, half.x(), half.y()), capsuleShape(half.x(), half.y()), surface};
      default: {
        std::vector<Vec3> points;
        for (int i = 0; i < 9; ++i) points.emplace_back(half.cwiseProduct(direction()));
        const Convex shape = hullOf(points).shape;
        const Mass inside = massOfShape(mass_kg, shape);
        return {key, inside, moved(shape, -inside.centre_O), surface};
      }
    }
  }
  Mat3 turn() { return Eigen::AngleAxisd(between(0, 3), direction()).toRotationMatrix(); }
};

// Way of a step over size: from 0.004 to 0.5.
TEST(FreeImpacts, KeepMomentumAndAddNoEnergy) {
  for (int seed = 0; seed < numberIn("HL_FREE_IMPACTS", 300); ++seed) {
    ImpactDraws draws(static_cast<std::uint64_t>(seed));
    const double size = std::exp(draws.between(std::log(0.002), std::log(0.2)));
    const double speed_m_s = size / kStep_s * std::exp(draws.between(std::log(0.004), std::log(0.5)));
    World world;
    world.gravity_m_s2.setZero();
    world.bodies = {draws.body(1, size), draws.body(2, size)};
    const Vec3 aside = size * Vec3(0, draws.between(-1, 1), draws.between(-1, 1));
    const Vec3 left(-2.5 * size, 0, 0), right = aside - left;
    Playground play(std::move(world), {placeAt(left, draws.turn()), placeAt(right, draws.turn())});
    play.state.bodies[0].velocity = Vec3(speed_m_s, 0, 0);
    play.state.bodies[1].spin = draws.between(0, 50) * draws.direction();
    const Vec3 before = play.momentum();
    const double before_J = play.energy_J();
    for (int step = 0; step < static_cast<int>(8 * size / (kStep_s * speed_m_s)); ++step) {
      play.step();
      ASSERT_LT((play.momentum() - before).norm(), 1e-12 * before.norm()) << seed << " step " << step;
      ASSERT_LT(play.energy_J(), before_J * (1 + 1e-4)) << seed << " step " << step;
    }
  }
}

// They meet beside their middles, and their faces stay flush: J = m v / (2 + m s^2 / (2 I)), I = 2/3 m h^2. In a step
// of 1 ms they turn by 12 mrad, and what that bends counts too.
TEST(FreeImpacts, OfCubesWithoutABounceGiveTheClosedForm) {
  constexpr double kHalf_m = 0.01, kMass_kg = 0.1, kSpeed_m_s = 2, kAside_m = 0.004;
  const double share = 1 / (2 + kAside_m * kAside_m / (4.0 / 3.0 * kHalf_m * kHalf_m));
  for (const auto& [period_s, tolerance] : {std::pair(1e-5, 1e-9), std::pair(1e-3, 0.02)}) {
    World world;
    world.gravity_m_s2.setZero();
    for (const std::uint64_t key : {1, 2}) world.bodies.push_back(block(key, kMass_kg, Vec3::Constant(kHalf_m), 0));
    Playground play(std::move(world), {placeAt(Vec3(-0.03, kAside_m, 0)), placeAt(Vec3(0.01, 0, 0))}, period_s);
    const BodyState &a = play.state.bodies[0], &b = play.state.bodies[1];
    play.state.bodies[0].velocity = Vec3(kSpeed_m_s, 0, 0);
    for (int step = 0; step < 2000 && b.velocity == Vec3::Zero(); ++step) play.step();
    EXPECT_NEAR(b.velocity.x(), kSpeed_m_s * share, tolerance * kSpeed_m_s);
    EXPECT_NEAR(a.spin.z(), b.spin.z(), 1e-9);
    const double left_J = kMass_kg * kSpeed_m_s * kSpeed_m_s / 2 * (1 - share);
    EXPECT_NEAR(kineticEnergy_J(*play.world, play.state), left_J, tolerance * left_J);
    play.steps(100);
    EXPECT_LT((a.velocity + b.velocity - Vec3(kSpeed_m_s, 0, 0)).norm(), 1e-12);
    EXPECT_GT(kineticEnergy_J(*play.world, play.state), 0.95 * left_J);
  }
}

}  // namespace
}  // namespace hl::test_free_impacts
