// Primitives: sorted vertices, the normal of the given order, and what is refused.
#include "geometry/primitive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/scenes.h"

namespace hl::test_primitive {
namespace {

TEST(Primitive, VerticesAreSortedAndOrderMapsBack) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const std::array<Vec3, 3> given{random.inCube(1), random.inCube(1), random.inCube(1)};
    Primitive triangle;
    ASSERT_TRUE(makeTriangle(given[0], given[1], given[2], 7, triangle));
    EXPECT_EQ(triangle.source, 7u);
    EXPECT_LE(triangle.vertex[0].x(), triangle.vertex[1].x());
    EXPECT_LE(triangle.vertex[1].x(), triangle.vertex[2].x());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(triangle.vertex[k], given[triangle.order[k]]);
  }
}

TEST(Primitive, NormalFollowsTheGivenOrderAndOnlyItsSignChangesWithIt) {
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random.inCube(1), b = random.inCube(1), c = random.inCube(1);
    Primitive first, turned, flipped;
    ASSERT_TRUE(makeTriangle(a, b, c, 0, first));
    ASSERT_TRUE(makeTriangle(b, c, a, 0, turned));
    ASSERT_TRUE(makeTriangle(b, a, c, 0, flipped));
    EXPECT_GT(first.normal.dot((b - a).cross(c - a)), 0);
    EXPECT_NEAR(first.normal.norm(), 1, 1e-15);
    EXPECT_EQ(first.normal, turned.normal);
    EXPECT_EQ(first.normal, -flipped.normal);
  }
}

TEST(Primitive, DegenerateAndNonFiniteAreRefusedAndLeaveTheResultAlone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Primitive out;
  out.source = 99;
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(2, 0, 0);
  EXPECT_FALSE(makeTriangle(a, b, c, 0, out));
  EXPECT_FALSE(makeTriangle(a, a, b, 0, out));
  EXPECT_FALSE(makeTriangle(a, b, Vec3(0.5, 1e-12, 0), 0, out));
  EXPECT_FALSE(makeTriangle(a, b, Vec3(nan, 1, 0), 0, out));
  EXPECT_FALSE(makeTriangle(a, b, Vec3(0, infinity, 0), 0, out));
  EXPECT_FALSE(makeTriangle(a, Vec3(1e200, 0, 0), Vec3(0, 1e200, 0), 0, out));
  EXPECT_FALSE(test::makeSegment(a, a, 0, out));
  EXPECT_FALSE(test::makeSegment(a, Vec3(0, nan, 0), 0, out));
  EXPECT_FALSE(test::makePoint(Vec3(0, 0, infinity), 0, out));
  EXPECT_FALSE(test::makePoint(Vec3(0, -1.001 * kFarthest_m, 0), 0, out));
  EXPECT_EQ(out.source, 99u);
  EXPECT_TRUE(test::makePoint(Vec3(0, -kFarthest_m, 0), 0, out));
  EXPECT_TRUE(makeTriangle(a, b, Vec3(0.5, 1e-10, 0), 0, out));
}

TEST(Primitive, NegativeZeroIsTheSameVertexAsZero) {
  Primitive point;
  ASSERT_TRUE(test::makePoint(Vec3(-0.0, 0.0, -0.0), 0, point));
  for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(point.vertex[0][axis]));
}

TEST(Primitive, SegmentsAndPointsRepeatTheirLastVertex) {
  Primitive segment, point;
  ASSERT_TRUE(test::makeSegment(Vec3(1, 0, 0), Vec3(0, 0, 0), 3, segment));
  EXPECT_EQ(segment.vertex[0], Vec3(0, 0, 0));
  EXPECT_EQ(segment.vertex[2], segment.vertex[1]);
  EXPECT_EQ(segment.order[0], 1);
  ASSERT_TRUE(test::makePoint(Vec3(1, 2, 3), 4, point));
  EXPECT_EQ(point.vertex[2], point.vertex[0]);
}

}  // namespace
}  // namespace hl::test_primitive
