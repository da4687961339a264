// A proxy that things have come too near to: it goes out on its side of them, and pinched it takes the most room.
#include "proxy/push_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/scenes.h"
#include "judge.h"
#include "moving_scenes.h"
#include "proxy/clear_place.h"

namespace hl::test_push_out {
namespace {

constexpr double kRadius = 0.002;

Vec3 pushedIn(const Snapshot& scene, const Vec3& from) {
  return pushedOut(scene, Tolerances::of(kRadius, scene.extent), from);
}

// Plates at y = 0 and y = gap.
std::shared_ptr<const Snapshot> plates(double gap) {
  const Model plate = test::rectangle({-0.1, 0, 0.1}, {0.2, 0, 0}, {0, 0, -0.2});
  return makeSnapshot({test::place(1, plate, Motion()), test::place(2, plate, Motion(test::at({0, gap, 0})))});
}

TEST(PushOut, WhereThereIsRoomItStaysToTheBit) {
  const auto scene = plates(0.05);
  const Vec3 place(0.001, 1.01 * kRadius, 0.002);
  EXPECT_EQ(pushedIn(*scene, place), place);
}

TEST(PushOut, ItGoesStraightOutOnTheSideOfItsCentre) {
  const auto scene = plates(0.05);
  for (const double part : {1e-6, 0.01, 0.3, 0.95, -0.95, -0.3, -1e-6}) {
    const Vec3 out = pushedIn(*scene, {0.001, part * kRadius, 0.002});
    EXPECT_NEAR((out - Vec3(0.001, std::copysign(kRadius, part), 0.002)).norm(), 0, 1e-8) << part;
  }
}

TEST(PushOut, BetweenPlatesTooNearItTakesAQuarterOfTheRoomAtLeast) {
  for (const double gap : {1.9, 1.0, 0.5, 0.1, 0.02}) {
    const auto scene = plates(gap * kRadius);
    for (const double part : {0.01, 0.3, 0.5, 0.99}) {
      const Vec3 out = pushedIn(*scene, {0, part * gap * kRadius, 0});
      const double room = std::min(out.y(), gap * kRadius - out.y());
      EXPECT_GE(room, 0.25 * gap / 2 * kRadius) << "gap " << gap << ", from " << part;
    }
  }
}

// Four faces about a place, mostly too near to one another for the proxy.
struct Tetrahedron {
  explicit Tetrahedron(test::Random& random) {
    Model model;
    for (int i = 0; i < 4; ++i) model.positions.push_back(random.inCube(5 * kRadius));
    model.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    origin = model.positions[0];
    for (int i = 0; i < 3; ++i) edges.col(i) = model.positions[1 + i] - origin;
    scene = makeSnapshot({test::place(1, std::move(model), Motion())});
  }
  bool holds(const Vec3& p) const {
    const Vec3 weights = edges.inverse() * (p - origin);
    return weights.minCoeff() > 0 && weights.sum() < 1;
  }
  double roomAt(const Vec3& p) const { return judge::clearance(*scene, p, kRadius); }

  Vec3 origin;
  Mat3 edges;
  std::shared_ptr<const Snapshot> scene;
};

// It stays inside, has half the room that it had at least, and no less than its first try found.
TEST(PushOut, ItNeitherLeavesATetrahedronNorGivesUpMuchRoom) {
  test::Random random(1);
  int pinched = 0;
  for (int i = 0; i < 4000; ++i) {
    const Tetrahedron around(random);
    const Vec3 from = around.origin + around.edges * (Vec3::Constant(0.05) + 0.2 * random.inCube(1).cwiseAbs());
    if (around.roomAt(from) < 0.01 * kRadius) continue;
    const Vec3 out = pushedIn(*around.scene, from);
    ASSERT_TRUE(around.holds(out)) << i;
    ASSERT_GE(around.roomAt(out), 0.5 * around.roomAt(from)) << i;
    Vec3 tried = from;
    const auto tolerance = Tolerances::of(kRadius, around.scene->extent);
    pinched += findClearPlace(*around.scene, tolerance, convergence::kPushTries, tried) ? 0 : 1;
    ASSERT_GE(around.roomAt(out), around.roomAt(tried)) << i;
  }
  EXPECT_GT(pinched, 1000);
}

}  // namespace
}  // namespace hl::test_push_out
