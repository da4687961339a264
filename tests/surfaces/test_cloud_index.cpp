// The index of a cloud against the hierarchy over the same points or surfels as a mesh: the same answers bit for bit.
#include "surfaces/cloud_index.h"

#include <gtest/gtest.h>

#include "clouds.h"
#include "geometry/queries.h"
#include "guard/realtime_guard.h"
#include "index_judge.h"

namespace hl::test_cloud_index {
namespace {

using test::Random;

test::TestBall randomBall(Random& random, const PointCloud& cloud) {
  const double spacing = cloud.spacing();
  const std::size_t slot =
      static_cast<std::size_t>(random.below(static_cast<int>(cloud.points()->blocks()))) * CloudPoints::kPerBlock;
  const Vec3 near = cloud.corners(slot * cloud.perPoint())[0];
  return {near + 3 * spacing * random.inCube(1), spacing * std::pow(10.0, random.uniform(-2, 1)), spacing};
}

TEST(CloudIndex, FirstImpactsAreThoseOfTheMesh) { test::expectImpactsOfMesh(test::randomCloud, randomBall, 20); }

TEST(CloudIndex, WhatIsWithinADistanceIsWhatIsOfTheMesh) { test::expectDistancesOfMesh(test::randomCloud, randomBall); }

TEST(CloudIndex, TheNearestPrimitiveIsThatOfTheMesh) { test::expectNearestOfMesh(test::randomCloud, randomBall); }

// A sheet of 250 000 points: few boxes and points are looked at, and nothing is allocated.
TEST(CloudIndex, AQueryLooksAtFewPoints) {
  const PointCloud cloud(test::cloudOf(test::squareGrid(500, 0.5e-3)), CloudLook{});
  const CloudIndex index(cloud.cloud());
  Random random(4);
  std::size_t looked = 0, visited = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 above(random.uniform(-0.1, 0.1), 0.002, random.uniform(-0.1, 0.1));
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(cloud, id); };
    FirstImpact impact;
    const RealtimeGuard guard;
    ASSERT_TRUE(firstImpact(index, read, above, Vec3(0, -0.01, 0), 1e-3, 0, impact));
    looked += index.overlap(above - Vec3(0, 0.01 * impact.impact.t, 0), 1.001e-3, [&](ElementId) { ++visited; });
  }
  RecordProperty("looked", std::to_string(looked / 200));
  EXPECT_LT(looked / 200, 300U);
  EXPECT_LT(visited / 200, 30U);
  EXPECT_GE(visited, 200U);
}

}  // namespace
}  // namespace hl::test_cloud_index
