// C06, C07: the time of impact of a swept sphere against a long double judge, and the continuity of its normal.
#include "geometry/sweep.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "cases.h"
#include "geometry/closest_point.h"
#include "geometry/judge.h"
#include "geometry/scenes.h"

namespace hl::test_sweep {
namespace {

struct Case {
  Primitive primitive;
  Vec3 from, motion;
  double radius = 0;
  double scene = 0;  // m, the largest length in the case
};

// What every sweep must keep, with tolerances of distance relative to the scene: a hit is at distance `radius`, nothing
// is entered before it, a miss enters nothing. Where the path is not grazing the time itself agrees.
void judge(const Case& c) {
  const double tolerance = 1e-12 * c.scene;
  const double start = static_cast<double>(test::judgedDistance(c.primitive, c.from.cast<test::Real>()));
  Impact impact;
  const bool hit = sweepSphere(c.primitive, c.from, c.motion, c.radius, impact);
  if (start < c.radius + tolerance) {
    if (hit) {
      ASSERT_LE(impact.t * c.motion.norm(), c.scene);
    }
    return;
  }
  const test::JudgedSweep judged = test::judgedSweep(c.primitive, c.from, c.motion, c.radius);
  if (!hit) {
    ASSERT_GE(static_cast<double>(judged.nearest), c.radius - tolerance) << "missed an impact";
    return;
  }
  ASSERT_GE(impact.t, 0);
  ASSERT_LE(impact.t, 1);
  const Vec3 at = c.from + impact.t * c.motion;
  const double distance = static_cast<double>(test::judgedDistance(
      c.primitive, c.from.cast<test::Real>() + test::Real(impact.t) * c.motion.cast<test::Real>()));
  ASSERT_NEAR(distance, c.radius, tolerance) << "not in contact at the time of impact";
  const ClosestPoint nearest = closestPoint(c.primitive, at);
  ASSERT_LT((impact.normal - nearest.normal).norm() * c.radius, 1e-6 * c.scene);
  ASSERT_NEAR(impact.normal.norm(), 1, 1e-12);
  ASSERT_LT(impact.normal.dot(c.motion.normalized()) * c.radius, tolerance) << "an impact moves against the normal";
  // Time: the path error is the distance error over the sine of the angle of approach.
  const double sine = -impact.normal.dot(c.motion.normalized());
  if (judged.hit && sine > 1e-3) {
    ASSERT_NEAR(impact.t * c.motion.norm(), static_cast<double>(judged.t) * c.motion.norm(), 2 * tolerance / sine);
  }
}

Case randomCase(test::Random& random) {
  Case c;
  const double scale = std::pow(10.0, random.uniform(-6, 6));
  c.primitive = test::randomPrimitive(random, scale, scale, 0);
  c.radius = scale * std::pow(10.0, random.uniform(-4, 0.3));
  const Vec3 aim = c.primitive.vertex[static_cast<std::size_t>(random.below(3))];
  const Vec3 middle = (c.primitive.vertex[0] + c.primitive.vertex[1] + c.primitive.vertex[2]) / 3;
  const double far = scale * std::pow(10.0, random.uniform(-2, 2));
  c.from = middle + random.direction() * (far + c.radius);
  const Vec3 target =
      random.below(2) == 0 ? Vec3(aim + c.radius * random.inCube(1.5)) : Vec3(middle + random.inCube(scale));
  c.motion = (target - c.from) * random.uniform(0.1, 2.5);
  c.scene = std::max({scale, c.from.norm(), c.motion.norm()}) + c.radius;
  return c;
}

// A path that just touches or just misses: tangent to the obstacle at a random place, off by a tiny amount.
Case grazingCase(test::Random& random) {
  Case c = randomCase(random);
  const ClosestPoint nearest = closestPoint(c.primitive, c.from);
  const Vec3 normal = nearest.normal;
  const Vec3 along = normal.cross(random.direction()).normalized();
  const double off = c.radius * random.uniform(-1, 1) * std::pow(10.0, random.uniform(-15, -6));
  const double length = c.scene * random.uniform(0.1, 1);
  c.from = nearest.point + (c.radius + off) * normal - length * along;
  c.motion = 2 * length * along;
  c.scene += length;
  return c;
}

TEST(SweepSphere, C06TimeOfImpactAgreesWithTheJudge) {
  test::Random random(21);
  for (int i = 0; i < test::cases(20000); ++i) {
    judge(randomCase(random));
    if (HasFatalFailure()) FAIL() << "case " << i;
  }
}

TEST(SweepSphere, C06GrazingPathsAreWithinRounding) {
  test::Random random(22);
  for (int i = 0; i < test::cases(20000); ++i) {
    judge(grazingCase(random));
    if (HasFatalFailure()) FAIL() << "case " << i;
  }
}

TEST(SweepSphere, C06AimedAtBordersBetweenFacesEdgesAndVerticesNothingIsMissed) {
  test::Random random(23);
  for (int i = 0; i < test::cases(200000); ++i) {
    const Primitive primitive = test::randomPrimitive(random, 1, 1, 0);
    const double radius = std::pow(10.0, random.uniform(-5, 0));
    // Straight at a vertex or a point of an edge, along a normal of the border of two parts.
    const auto u = static_cast<std::size_t>(random.below(3));
    const auto v = static_cast<std::size_t>(random.below(3));
    const Vec3 target = primitive.vertex[u] + random.below(4) / 3.0 * (primitive.vertex[v] - primitive.vertex[u]);
    const Vec3 along =
        random.below(2) == 0 && primitive.kind == PrimitiveKind::kTriangle ? primitive.normal : random.direction();
    Impact impact;
    const Vec3 from = target + (1 + 2 * radius + 3) * along;
    ASSERT_TRUE(sweepSphere(primitive, from, 2 * (target - from), radius, impact)) << i;
    const Vec3 at = from + impact.t * 2 * (target - from);
    ASSERT_NEAR(closestPoint(primitive, at).distance, radius, 1e-13 * 10) << i;
  }
}

RC_GTEST_PROP(SweepSphere, C06EveryIntegerCaseAgreesWithTheJudge, ()) {
  const auto coordinate = rc::gen::inRange(-4, 5);
  const auto vec = [&] { return Vec3(*coordinate, *coordinate, *coordinate); };
  Case c;
  const Vec3 a = vec(), b = vec(), d = vec();
  if (!makeTriangle(a, b, d, 0, c.primitive) && !test::makeSegment(a, b, 0, c.primitive))
    test::makePoint(a, 0, c.primitive);
  c.from = vec();
  c.motion = vec();
  c.radius = *rc::gen::inRange(1, 8) * 0.25;
  c.scene = 16;
  if (c.motion.isZero()) {
    Impact impact;
    RC_ASSERT(!sweepSphere(c.primitive, c.from, c.motion, c.radius, impact));
    return;
  }
  judge(c);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

TEST(SweepSphere, StartsInContactHitAtOnceWhenApproachingAndElseNever) {
  test::Random random(24);
  for (int i = 0; i < test::cases(50000); ++i) {
    const Primitive primitive = test::randomPrimitive(random, 1, 1, 0);
    const Vec3 from = random.inCube(1.5);
    const ClosestPoint nearest = closestPoint(primitive, from);
    const Vec3 motion = random.inCube(1);
    const double radius = nearest.distance * (random.below(3) == 0 ? 1.0 : random.uniform(1, 3));
    Impact impact;
    const bool hit = sweepSphere(primitive, from, motion, radius, impact);
    ASSERT_EQ(hit, motion.dot(nearest.normal) < 0);
    if (!hit) continue;
    ASSERT_EQ(impact.t, 0);
    ASSERT_EQ(impact.normal, nearest.normal);
    ASSERT_EQ(impact.feature, nearest.feature);
  }
}

TEST(SweepSphere, WhatComesTooLateMayBeLeftOutButNothingElseChanges) {
  test::Random random(25);
  int hits = 0, left_out = 0;
  for (int i = 0; i < test::cases(100000); ++i) {
    const Primitive primitive = test::randomPrimitive(random, 1, 1, 0);
    const Vec3 from = random.inCube(2), motion = primitive.vertex[0] + random.inCube(0.3) - from;
    const double radius = 0.2 * random.uniform(0.1, 1);
    if (closestPoint(primitive, from).distance <= radius) continue;
    Impact whole, part;
    const bool hit = sweepSphereFromOutside(primitive, from, motion, radius, 1, whole);
    const double latest = random.below(4) == 0 ? whole.t : random.uniform(0, 1);
    const bool hit_part = sweepSphereFromOutside(primitive, from, motion, radius, latest, part);
    ASSERT_TRUE(hit || !hit_part);
    if (hit && whole.t <= latest) {
      ASSERT_TRUE(hit_part);
    }
    if (hit_part) {
      ASSERT_EQ(part.t, whole.t);
      ASSERT_EQ(part.normal, whole.normal);
    }
    hits += hit_part;
    left_out += hit && !hit_part;
  }
  EXPECT_GT(hits, test::cases(1000));
  EXPECT_GT(left_out, test::cases(1000));
}

TEST(SweepSphere, TheFaceIsTwoSided) {
  Primitive triangle;
  ASSERT_TRUE(makeTriangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 0, triangle));
  for (const double side : {1.0, -1.0}) {
    Impact impact;
    ASSERT_TRUE(sweepSphere(triangle, Vec3(0.25, 0.25, side), Vec3(0, 0, -2 * side), 0.5, impact));
    EXPECT_EQ(impact.t, 0.25);
    EXPECT_EQ(impact.normal, Vec3(0, 0, side));
    EXPECT_EQ(impact.feature, Feature::kFace);
  }
}

TEST(SweepSphere, C07TheNormalTurnsContinuouslyFromFaceOverEdge) {
  Primitive triangle;
  ASSERT_TRUE(makeTriangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 0, triangle));
  const double radius = 0.1;
  Vec3 last = Vec3::UnitZ();
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double y = 0.05 - 0.149 * i / kSteps;  // from inside the face to nearly one radius beyond edge y = 0
    Impact impact;
    ASSERT_TRUE(sweepSphere(triangle, Vec3(0.3, y, 1), Vec3(0, 0, -2), radius, impact));
    const Vec3 expected(0, std::min(0.0, y) / radius, std::sqrt(1 - std::pow(std::min(0.0, y) / radius, 2)));
    ASSERT_LT((impact.normal - expected).norm(), 1e-9);
    ASSERT_LT((impact.normal - last).norm(), 1e-3);
    last = impact.normal;
  }
}

}  // namespace
}  // namespace hl::test_sweep
