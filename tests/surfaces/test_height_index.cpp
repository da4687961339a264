// The index of a height field against the hierarchy over the same triangles as a mesh: the same answers bit for bit.
#include "surfaces/height_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fields.h"
#include "geometry/queries.h"
#include "guard/realtime_guard.h"
#include "index_judge.h"

namespace hl::test_height_index {
namespace {

using test::Random;

test::TestBall randomBall(Random& random, const HeightField& field) {
  const GridFrame& frame = field.frame();
  const double column = random.uniform(-2, field.grid().columns() + 1.0),
               row = random.uniform(-2, field.grid().rows() + 1.0);
  const auto within = [](double at, std::uint32_t side) {
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, side - 1.0));
  };
  double value = field.grid().at(within(column, field.grid().columns()), within(row, field.grid().rows()));
  if (std::isnan(value)) value = field.pyramid().lowest();
  const double cell = std::sqrt(frame.axes.col(0).norm() * frame.axes.col(1).norm());
  const double radius = cell * std::pow(10.0, random.uniform(-2, 1.3));
  const Vec3 up = frame.axes.col(0).cross(frame.axes.col(1)).normalized();
  return {frame.point(column, row, value) + random.uniform(-1.5, 1.5) * radius * up, radius, cell};
}

TEST(HeightIndex, FirstImpactsAreThoseOfTheMesh) { test::expectImpactsOfMesh(test::randomField, randomBall, 8); }

TEST(HeightIndex, WhatIsWithinADistanceIsWhatIsOfTheMesh) {
  test::expectDistancesOfMesh(test::randomField, randomBall);
}

TEST(HeightIndex, TheNearestTriangleIsThatOfTheMesh) { test::expectNearestOfMesh(test::randomField, randomBall); }

// A smooth slope of 10^6 triangles: few slabs and cells are looked at, however many the ball covers.
TEST(HeightIndex, AQueryLooksAtFewSlabs) {
  const auto field = test::fieldOf(708, 708, 1e-5, [](double i, double j) {
    return 3e-6 * i + 1e-6 * j + 1e-4 * std::sin(0.02 * i) * std::cos(0.015 * j);
  });
  const auto own = field->makeIndex();
  const SpatialIndex& index = *own;
  Random random(4);
  std::size_t looked = 0, visited = 0, fewest = 1'000'000;
  for (int i = 0; i < 200; ++i) {
    const Vec3 above = field->frame().point(random.uniform(150, 550), random.uniform(150, 550), 0) + Vec3(0, 0.01, 0);
    FirstImpact impact;
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*field, id); };
    ASSERT_TRUE(firstImpact(index, read, above, Vec3(0, -0.02, 0), 1e-3, 0, impact));
    const Vec3 centre = above + impact.impact.t * Vec3(0, -0.02, 0);
    const RealtimeGuard guard;
    std::size_t near = 0;
    looked += index.overlap(centre, 1.0001e-3, [&](ElementId) { ++near; });
    visited += near;
    fewest = std::min(fewest, near);
  }
  EXPECT_GE(fewest, 1U);
  EXPECT_LT(looked / 200, 600U);
  EXPECT_LT(visited / 200, 60U);
}

}  // namespace
}  // namespace hl::test_height_index
