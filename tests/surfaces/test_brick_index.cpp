// The index of an iso surface against the hierarchy over the same triangles as a mesh: the same answers bit for bit.
#include "surfaces/brick_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/queries.h"
#include "guard/realtime_guard.h"
#include "index_judge.h"
#include "volumes.h"

namespace hl::test_brick_index {
namespace {

using test::Random;

test::TestBall randomBall(Random& random, const IsoSurface& surface) {
  const GridFrame& frame = surface.frame();
  const VoxelGrid& grid = surface.volume()->grid;
  const auto along = [&](std::size_t axis) { return random.uniform(-2, grid.cells(axis) + 2.0); };
  const double cell = std::cbrt(std::abs(frame.axes.determinant()));
  return {frame.point(along(0), along(1), along(2)), cell * std::pow(10.0, random.uniform(-2, 1)), cell};
}

TEST(BrickIndex, FirstImpactsAreThoseOfTheMesh) { test::expectImpactsOfMesh(test::randomSurface, randomBall, 10); }

TEST(BrickIndex, WhatIsWithinADistanceIsWhatIsOfTheMesh) {
  test::expectDistancesOfMesh(test::randomSurface, randomBall);
}

TEST(BrickIndex, TheNearestTriangleIsThatOfTheMesh) { test::expectNearestOfMesh(test::randomSurface, randomBall); }

// A sphere of 10^6 triangles: few bricks and cells are looked at.
TEST(BrickIndex, AQueryLooksAtFewCells) {
  const auto volume = test::volumeOf({256, 256, 256}, [](const Vec3& at) { return (at - Vec3::Constant(127)).norm(); });
  const IsoSurface surface(volume, test::cubicFrame(0.5e-3), {120, SolidSide::kBelow});
  const BrickIndex index(surface.cells(), surface.bounds());
  Random random(4);
  std::size_t looked = 0, visited = 0, fewest = 1'000'000;
  for (int i = 0; i < 200; ++i) {
    const Vec3 way = random.direction(), above = Vec3::Constant(0.0635) + 0.065 * way;
    FirstImpact impact;
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(surface, id); };
    ASSERT_TRUE(firstImpact(index, read, above, -0.02 * way, 1e-3, 0, impact));
    const Vec3 centre = above - impact.impact.t * 0.02 * way;
    const RealtimeGuard guard;
    std::size_t near = 0;
    looked += index.overlap(centre, 1.0001e-3, [&](ElementId) { ++near; });
    visited += near;
    fewest = std::min(fewest, near);
  }
  RecordProperty("looked", std::to_string(looked / 200));
  RecordProperty("visited", std::to_string(visited / 200));
  EXPECT_GE(fewest, 1U);
  EXPECT_LT(looked / 200, 500U);
  EXPECT_LT(visited / 200, 60U);
}

}  // namespace
}  // namespace hl::test_brick_index
