// Random worlds in a closed room: nothing leaves it, nothing passes through anything, and every joule is booked.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "bodies/convex_hull.h"
#include "bodies/mesh_body.h"
#include "draws.h"
#include "mesh_drawings.h"

namespace hl::test_random_worlds {
namespace {

using namespace test;

constexpr double kRoom_m = 0.15;  // half of its sides

struct RandomWorld : Draws {
  // With this many kinds of shapes: six that are convex, then what is made of parts.
  RandomWorld(std::uint64_t seed, unsigned kinds) : Draws(seed), kinds_(kinds) {
    world.fixed = makeSnapshot(boxModel(Vec3::Constant(kRoom_m)));
    const int count = 2 + static_cast<int>(random() % 12);
    world.gravity_m_s2 = Vec3(0, random() % 2 == 0 ? -9.81 : 0, 0);
    for (int i = 0; i < count; ++i) addBody(i, count);
  }
  // Bodies begin in the cells of a grid, so that none touches another.
  void addBody(int number, int count) {
    const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count))));
    const double cell = 1.9 * kRoom_m / side, most = 0.45 * cell;
    const Vec3 at = Vec3::Constant(-0.95 * kRoom_m) +
                    cell * Vec3(number % side + 0.5, number / side % side + 0.5, number / side / side + 0.5);
    const double mass = std::exp(between(std::log(1e-6), std::log(1.0)));
    const BodySurface surface{0.7, between(0, 0.7), between(0, 1)};
    const auto key = static_cast<std::uint64_t>(number + 1);
    const double size = between(0.2, 1) * most;
    switch (random() % kinds_) {
      case 0:
        world.bodies.push_back({key, massOfBall(mass, size), ballShape(size), surface});
        break;
      case 1: {
        const Vec3 half = Vec3(between(0.2, 1), between(0.2, 1), between(0.2, 1)) * size / std::sqrt(3.0);
        world.bodies.push_back({key, massOfBox(mass, half), boxShape(half), surface});
        break;
      }
      case 2: {
        const Vec3 half(0.7 * size, 0.0005, 0.7 * size);  // a plate of 1 mm
        world.bodies.push_back({key, massOfBox(mass, half), boxShape(half), surface});
        break;
      }
      case 3: {
        std::vector<Vec3> points;
        for (int i = 0; i < 12; ++i) points.emplace_back(size * between(0.5, 1) * direction());
        const Convex hull = hullOf(points).shape;
        const Mass inside = massOfShape(mass, hull);
        world.bodies.push_back({key, inside, moved(hull, -inside.centre_O), surface});
        break;
      }
      case 4:
        world.bodies.push_back(
            {key, massOfCylinder(mass, 0.6 * size, 0.6 * size), cylinderShape(0.6 * size, 0.6 * size), surface});
        break;
      case 5:
        world.bodies.push_back(
            {key, massOfCapsule(mass, 0.6 * size, 0.3 * size), capsuleShape(0.6 * size, 0.3 * size), surface});
        break;
      default:
        world.bodies.push_back(bodyOfParts(key, mass, size, surface));
    }
    poses.push_back(placeAt(at, Eigen::AngleAxisd(between(0, 3), direction()).toRotationMatrix()));
    const double hot = random() % 3 == 0 ? 1 : 0.1;
    velocities.emplace_back(hot * between(0, 10) * direction());
    spins.emplace_back(hot * between(0, 100) * direction());
  }

  // A ring, a cup with walls of 1 mm, or an L.
  Body bodyOfParts(std::uint64_t key, double mass_kg, double size, const BodySurface& surface) {
    BodySpec spec;
    spec.shape = BodyShape::kParts;
    spec.mass_kg = mass_kg;
    spec.surface = surface;
    const double s = size / 2;
    const unsigned kind = random() % 3;
    const Model model = kind == 0   ? ringModel(0.6 * s, s, 0.3 * s, 8)
                        : kind == 1 ? cupModel(s, s, 0.001)
                                    : boxesModel({{Vec3(0.2, 1, 0.3) * s, Vec3(0.2, 0, 0) * s},
                                                  {Vec3(0.4, 0.2, 0.3) * s, Vec3(0.8, -0.8, 0) * s}});
    Body body = bodyOf(model, spec);
    body.key = key;
    return body;
  }

  World world;
  std::vector<Pose> poses;
  std::vector<Vec3> velocities, spins;

 private:
  unsigned kinds_;
};

void expectThatNothingLeaves(unsigned kinds) {
  const int begin = numberIn("HL_FIRST_WORLD", 0);
  for (int seed = begin; seed < begin + numberIn("HL_RANDOM_WORLDS", 20); ++seed) {
    RandomWorld made(static_cast<std::uint64_t>(seed), kinds);
    Playground play(made.world, made.poses);
    for (std::size_t i = 0; i < made.velocities.size(); ++i) {
      play.state.bodies[i].velocity = made.velocities[i];
      play.state.bodies[i].spin = made.spins[i];
    }
    const double begin_J = play.energy_J();
    double not_booked_J = 0;  // rounding: a light body between heavy ones gets impulses far beyond its momentum
    for (int step = 0; step < 1000; ++step) {
      const BodyStepReport report = play.step();
      ASSERT_EQ(report.dropped, 0u);
      const EnergyBook& book = play.state.energy;
      const double booked = book.solver_J - book.contact_J - book.friction_J;
      const double last_not_booked_J = std::exchange(not_booked_J, play.energy_J() - begin_J - booked);
      ASSERT_NEAR(not_booked_J, last_not_booked_J, 1e-9 * (1 + std::abs(begin_J))) << seed << " step " << step;
      ASSERT_LT(play.energy_J() - begin_J, 0.05 * (1e-3 + std::abs(begin_J))) << seed << " step " << step;
      for (const BodyState& body : play.state.bodies)
        ASSERT_TRUE(body.centre.allFinite() && body.centre.cwiseAbs().maxCoeff() < kRoom_m) << seed << " step " << step;
    }
  }
}

TEST(RandomWorlds, NothingLeavesAClosedRoom) { expectThatNothingLeaves(6); }
TEST(RandomWorlds, NothingOfPartsLeavesAClosedRoom) { expectThatNothingLeaves(9); }

}  // namespace
}  // namespace hl::test_random_worlds
