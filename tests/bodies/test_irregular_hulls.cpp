// Irregular hulls: what has long and short faces side by side does not sink into what it falls on.
#include <gtest/gtest.h>

#include <algorithm>

#include "bodies/convex_hull.h"
#include "draws.h"
#include "test_worlds.h"

namespace hl::test_irregular_hulls {
namespace {

using namespace test;

// m; docs/bodies.md: what was judged overlapped by 21 um at most.
constexpr double kMostOverlap_m = 25e-6;

struct HullDraws : Draws {
  using Draws::Draws;
  Vec3 halfAxes() {
    switch (random() % 3) {
      case 0:
        return Vec3(0.002, 0.004, 0.02);  // long
      case 1:
        return Vec3(0.003, 0.015, 0.015);  // flat
      default:
        return Vec3(0.01, 0.01, 0.01);
    }
  }
  Body hull(std::uint64_t key) {
    const Vec3 half = halfAxes();
    const int count = 4 + static_cast<int>(random() % 12);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) points.emplace_back(between(0.6, 1) * half.cwiseProduct(direction()));
    const Convex shape = hullOf(points).shape;
    const double mass_kg = between(0.01, 0.1);
    const Mass inside = massOfShape(mass_kg, shape);
    return {key, inside, moved(shape, -inside.centre_O), {0.5, between(0, 0.7), 0}};
  }
  Mat3 turn() { return Eigen::AngleAxisd(between(0, 3), direction()).toRotationMatrix(); }
};

// Of the corners of a body along a direction, m.
double lowestOf(const Body& body, const BodyState& state, const Vec3& along) {
  double least = 1e9;
  for (const Vec3& vertex : body.shape.parts[0].vertices)
    least = std::min(least, along.dot(state.centre + state.turned * vertex));
  return least;
}

// In no direction narrower than it says, and by no more than what 3000 directions leave open.
TEST(IrregularHulls, AreAsThinAsTheySay) {
  HullDraws draws(7);
  for (int i = 0; i < 100; ++i) {
    const Body body = draws.hull(1);
    const Convex& shape = body.shape.parts[0];
    double least = 1;
    for (int k = 0; k < 3000; ++k) {
      const Vec3 along = draws.direction();
      const auto [low, high] =
          std::minmax_element(shape.vertices.begin(), shape.vertices.end(),
                              [&](const Vec3& x, const Vec3& y) { return along.dot(x) < along.dot(y); });
      least = std::min(least, along.dot(*high - *low));
    }
    EXPECT_LE(2 * shape.thin, least * (1 + 1e-9)) << i;
    EXPECT_GE(2 * shape.thin, least - 0.1 * shape.reach) << i;
  }
}

TEST(IrregularHulls, FallOnAFloorAndLieOnIt) {
  for (int seed = 0; seed < numberIn("HL_RANDOM_HULLS", 60); ++seed) {
    HullDraws draws(static_cast<std::uint64_t>(seed));
    World world;
    world.fixed = floorScene(0.5);
    world.bodies.push_back(draws.hull(1));
    Playground play(std::move(world), {placeAt(Vec3(0, 0.03, 0), draws.turn())});
    double lowest = 0;
    for (int step = 0; step < 1500; ++step) {
      play.step();
      lowest = std::min(lowest, lowestOf(play.world->bodies[0], play.state.bodies[0], Vec3::UnitY()));
    }
    EXPECT_GT(lowest, -kMostOverlap_m) << seed;
    EXPECT_LT(lowestOf(play.world->bodies[0], play.state.bodies[0], Vec3::UnitY()), 1e-5) << seed;
  }
}

TEST(IrregularHulls, PileUpInARoomAndStayInIt) {
  constexpr double kRoom_m = 0.03;
  for (int seed = 0; seed < numberIn("HL_RANDOM_PILES", 8); ++seed) {
    HullDraws draws(static_cast<std::uint64_t>(1000 + seed));
    World world;
    world.fixed = makeSnapshot(boxModel(Vec3(kRoom_m, 0.3, kRoom_m)));
    std::vector<Pose> poses;
    for (int i = 0; i < 8; ++i) {
      world.bodies.push_back(draws.hull(static_cast<std::uint64_t>(i + 1)));
      poses.push_back(placeAt(Vec3(0, -0.25 + 0.05 * i, 0), draws.turn()));
    }
    Playground play(std::move(world), poses);
    double deepest = 0;
    for (int step = 0; step < 2000; ++step) {
      play.step();
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const Body& body = play.world->bodies[i];
        const BodyState& state = play.state.bodies[i];
        deepest = std::max(deepest, -0.3 - lowestOf(body, state, Vec3::UnitY()));
        for (const Vec3& wall : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
          deepest = std::max(deepest, -kRoom_m - lowestOf(body, state, wall));
      }
    }
    EXPECT_LT(deepest, kMostOverlap_m) << seed;
  }
}

}  // namespace
}  // namespace hl::test_irregular_hulls
