// C01: the contact normal of a lone triangle (both sides), segment or point is (p - closest) / distance.
#include "geometry/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/judge.h"
#include "geometry/scenes.h"

namespace hl::test_closest_point {
namespace {

Vec3 weightedPoint(const Primitive& primitive, const std::array<double, 3>& weights) {
  return weights[0] * primitive.vertex[0] + weights[1] * primitive.vertex[1] + weights[2] * primitive.vertex[2];
}

TEST(ClosestPoint, C01NormalIsTowardThePointAndTwoSided) {
  test::Random random(11);
  for (int i = 0; i < 100000; ++i) {
    const Primitive primitive = test::randomPrimitive(random, 1, 1, 0);
    const Vec3 p = random.inCube(2);
    const ClosestPoint nearest = closestPoint(primitive, p);
    ASSERT_LT((nearest.normal - (p - nearest.point) / nearest.distance).norm(), 1e-9 / nearest.distance);
    if (nearest.feature == Feature::kFace) {
      ASSERT_TRUE(nearest.normal == primitive.normal || nearest.normal == -primitive.normal);
      // The mirror image on the other side has the opposite normal.
      const Vec3 mirrored = p - 2 * nearest.distance * nearest.normal;
      const ClosestPoint back = closestPoint(primitive, mirrored);
      if (back.feature == Feature::kFace) {
        ASSERT_EQ(back.normal, -nearest.normal);
      }
    }
  }
}

TEST(ClosestPoint, DistanceAgreesWithTheJudgeAtEveryScale) {
  test::Random random(12);
  for (int i = 0; i < 100000; ++i) {
    const double scale = std::pow(10.0, random.uniform(-9, 9));
    const Primitive primitive = test::randomPrimitive(random, scale, scale, 0);
    const double closeness = std::pow(10.0, random.uniform(-6, 1));
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    const Vec3 above = weightedPoint(primitive, {u, v, 1 - u - v}) + closeness * scale * primitive.normal;
    const Vec3 near_vertex =
        primitive.vertex[static_cast<std::size_t>(random.below(3))] + closeness * random.inCube(scale);
    const Vec3 p = random.below(2) == 0 ? above : near_vertex;
    const ClosestPoint nearest = closestPoint(primitive, p);
    const double judged = static_cast<double>(test::judgedDistance(primitive, p.cast<test::Real>()));
    ASSERT_NEAR(nearest.distance, judged, 1e-13 * scale * (1 + closeness)) << i;
  }
}

TEST(ClosestPoint, WeightsNameTheNearestPoint) {
  test::Random random(13);
  for (int i = 0; i < 100000; ++i) {
    Primitive triangle;
    if (!makeTriangle(random.inCube(1), random.inCube(1), random.inCube(1), 0, triangle)) continue;
    const ClosestPoint nearest = closestPoint(triangle, random.inCube(2));
    double sum = 0;
    for (const double weight : nearest.weights) {
      ASSERT_GE(weight, 0);
      ASSERT_LE(weight, 1);
      sum += weight;
    }
    ASSERT_NEAR(sum, 1, 1e-15 * 4);
    const double longest = 4;
    const double area =
        0.5 * (triangle.vertex[1] - triangle.vertex[0]).cross(triangle.vertex[2] - triangle.vertex[0]).norm();
    ASSERT_LT((weightedPoint(triangle, nearest.weights) - nearest.point).norm(), 1e-14 * longest * longest / area);
  }
}

TEST(ClosestPoint, NeighboursGiveTheSameBitsOnASharedEdgeAndVertex) {
  test::Random random(14);
  int on_edge = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random.inCube(1), b = random.inCube(1);
    Primitive left, right, segment;
    ASSERT_TRUE(makeTriangle(a, b, a + random.inCube(1), 0, left));
    ASSERT_TRUE(makeTriangle(b, a, b + random.inCube(1), 1, right));
    ASSERT_TRUE(test::makeSegment(b, a, 2, segment));
    const Vec3 p = random.inCube(2);
    const ClosestPoint of_segment = closestPoint(segment, p);
    for (const Primitive* triangle : {&left, &right}) {
      const ClosestPoint nearest = closestPoint(*triangle, p);
      if (nearest.distance != of_segment.distance) continue;
      ++on_edge;
      ASSERT_EQ(nearest.point, of_segment.point);
      ASSERT_EQ(nearest.normal, of_segment.normal);
    }
  }
  EXPECT_GT(on_edge, 1000);
}

TEST(ClosestPoint, WithinADistanceLeavesOutOnlyWhatIsFarther) {
  test::Random random(14);
  int left_out = 0, found = 0;
  for (int i = 0; i < 50000; ++i) {
    const Primitive primitive = test::randomPrimitive(random, 1, 1, 0);
    const Vec3 p = random.inCube(1.5);
    const double distance = random.uniform(0, 1);
    const ClosestPoint nearest = closestPoint(primitive, p);
    ClosestPoint within;
    if (!closestPointWithin(primitive, p, distance, within)) {
      ++left_out;
      ASSERT_GT(nearest.distance, distance * (1 - 1e-12));
      continue;
    }
    ++found;
    ASSERT_EQ(within.distance, nearest.distance);
    ASSERT_EQ(within.point, nearest.point);
    ASSERT_EQ(within.normal, nearest.normal);
  }
  EXPECT_GT(left_out, 1000);
  EXPECT_GT(found, 1000);
}

TEST(ClosestPoint, AtDistanceZeroTheNormalIsStillAUnitVector) {
  Primitive triangle, segment, point;
  ASSERT_TRUE(makeTriangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 0, triangle));
  ASSERT_TRUE(test::makeSegment(Vec3(0, 0, 0), Vec3(1, 0, 0), 0, segment));
  ASSERT_TRUE(test::makePoint(Vec3(1, 2, 3), 0, point));
  for (const Vec3& p : {Vec3(0.25, 0.25, 0), Vec3(0.5, 0, 0), Vec3(0, 0, 0)}) {
    EXPECT_EQ(closestPoint(triangle, p).distance, 0);
    EXPECT_EQ(closestPoint(triangle, p).normal, triangle.normal);
  }
  const ClosestPoint on_segment = closestPoint(segment, Vec3(0.5, 0, 0));
  EXPECT_EQ(on_segment.feature, Feature::kEdge0);
  EXPECT_NEAR(on_segment.normal.norm(), 1, 1e-15);
  EXPECT_EQ(on_segment.normal.x(), 0);
  EXPECT_EQ(closestPoint(point, Vec3(1, 2, 3)).normal, Vec3::UnitZ());
}

}  // namespace
}  // namespace hl::test_closest_point
