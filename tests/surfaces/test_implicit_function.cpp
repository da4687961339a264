// Implicit functions: their values against closed forms, and the bounds of intervals against samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "expressions.h"
#include "surfaces/implicit/implicit_function.h"

namespace hl::test_implicit_function {
namespace {

double valueAt(const Expression& expression, const Vec3& p) { return ImplicitFunction(expression).at(p); }

TEST(Elementary, SinesAreThoseOfTheLibrary) {
  test::Random random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.uniform(-1000, 1000);
    ASSERT_NEAR(sineOf(x), std::sin(x), 1e-15);
    ASSERT_NEAR(cosineOf(x), std::cos(x), 1e-15);
  }
  EXPECT_EQ(sineOf(0), 0);
  EXPECT_EQ(cosineOf(0), 1);
}

TEST(ImplicitFunction, IsTheDistanceFromBodies) {
  using test::box, test::sphere, test::torus;
  EXPECT_DOUBLE_EQ(valueAt(sphere(2, Vec3(1, 0, 0)), Vec3(4, 0, 0)), 1);
  EXPECT_DOUBLE_EQ(valueAt(torus(30, 10), Vec3(0, 45, 0)), 5);
  EXPECT_DOUBLE_EQ(valueAt(torus(30, 10), Vec3(0, 0, 0)), 20);
  EXPECT_DOUBLE_EQ(valueAt(box(Vec3(2, 4, 6)), Vec3(0, 5, 0)), 3);
  EXPECT_DOUBLE_EQ(valueAt(box(Vec3(2, 4, 6), 0.5), Vec3(1, 2, 9)), std::sqrt(0.5 + 6.5 * 6.5) - 0.5);
  EXPECT_DOUBLE_EQ(valueAt(test::rod(ExpressionKind::kCapsule, 1, 4), Vec3(0, 3, 6)), 4);
  EXPECT_DOUBLE_EQ(valueAt(test::rod(ExpressionKind::kCylinder, 1, 4), Vec3(0, 0, 6)), 4);
  EXPECT_DOUBLE_EQ(valueAt(test::halfSpace(Vec3(0, 2, 0), 1), Vec3(7, 3, 7)), 2);
  EXPECT_NEAR(valueAt(test::gyroid(1, 0), Vec3(0.01, 0.01, 0.01)), std::sqrt(3.0) * 0.01, 1e-4);
}

TEST(ImplicitFunction, IsPlaced) {
  Expression box = test::box(Vec3(2, 4, 6));
  box.axis = Vec3::UnitX();
  box.degrees = 90;
  box.scale = 2;
  box.place = Vec3(0, 0, 10);
  EXPECT_NEAR(valueAt(box, Vec3(0, 8, 10)), 2, 1e-12) << "its z has become -y";
  EXPECT_NEAR(valueAt(box, Vec3(0, 0, 15)), 1, 1e-12);
}

TEST(ImplicitFunction, IsPutTogether) {
  using K = ExpressionKind;
  const Expression a = test::sphere(1), b = test::sphere(1, Vec3(1.5, 0, 0));
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.inCube(3);
    const double at_a = valueAt(a, p), at_b = valueAt(b, p);
    ASSERT_EQ(valueAt(test::of(K::kUnion, {a, b}), p), std::min(at_a, at_b));
    ASSERT_EQ(valueAt(test::of(K::kIntersection, {a, b}), p), std::max(at_a, at_b));
    ASSERT_EQ(valueAt(test::of(K::kDifference, {a, b}), p), std::max(at_a, -at_b));
    ASSERT_NEAR(valueAt(test::changed(K::kShell, a, 0.2), p), std::abs(at_a) - 0.1, 1e-15);
    ASSERT_NEAR(valueAt(test::changed(K::kOffset, a, 0.2), p), at_a - 0.2, 1e-15);
    const double d = std::max(0.0, 0.5 - std::abs(at_a - at_b)) / 0.5;
    ASSERT_NEAR(valueAt(test::of(K::kUnion, {a, b}, 0.5), p), std::min(at_a, at_b) - d * d * 0.125, 1e-14);
    ASSERT_NEAR(valueAt(test::of(K::kIntersection, {a, b}, 0.5), p), std::max(at_a, at_b) + d * d * 0.125, 1e-14);
  }
}

// A blend of a box and a sphere is one of the sphere and each face.
TEST(ImplicitFunction, BlendsGoThroughEdges) {
  const Expression box = test::box(Vec3(2, 2, 2)), ball = test::sphere(1, Vec3(1, 1, 1));
  const ImplicitFunction function(test::of(ExpressionKind::kUnion, {box, ball}, 0.4));
  EXPECT_EQ(function.sheets().size(), 6U);
  test::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.inCube(3);
    ASSERT_NEAR(function.at(p), blendOf(valueAt(box, p), valueAt(ball, p), 0.4), 1e-14);
  }
}

TEST(ImplicitFunction, IntervalsHoldAllSamples) {
  test::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const ImplicitFunction function(test::randomSolid(random));
    const SmoothFunction& sheet =
        function.sheets()[static_cast<std::size_t>(random.below(static_cast<int>(function.sheets().size())))];
    const Vec3 first = random.inCube(0.03), size = std::pow(10.0, random.uniform(-6, -1.5)) * Vec3::Ones();
    SmoothFunction::Space box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      box[axis] = {first[a], first[a] + size[a]};
    }
    const auto bend = sheet.bendOver(box);
    const auto slope = sheet.slopeOver(box);
    const Interval value = sheet.over(box);
    Vec3 before = first, gradient_before = sheet.gradient(first);
    for (int n = 0; n < 100; ++n) {
      Vec3 p = first;
      for (Eigen::Index axis = 0; axis < 3; ++axis) p[axis] += random.uniform(0, 1) * size[axis];
      ASSERT_TRUE(value.holds(sheet.at(p)));
      ASSERT_TRUE(bend.value.holds(sheet.at(p)));
      const Vec3 gradient = sheet.gradient(p);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(slope.slope[axis].holds(gradient[static_cast<Eigen::Index>(axis)])) << i;
      // By the mean value: what the gradient changes on the way is within the second derivatives times the way.
      const Vec3 way = p - before;
      const auto& h = bend.bend;
      const std::array<Interval, 3> change{way.x() * h[0] + way.y() * h[5] + way.z() * h[4],
                                           way.x() * h[5] + way.y() * h[1] + way.z() * h[3],
                                           way.x() * h[4] + way.y() * h[3] + way.z() * h[2]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double changed = (gradient - gradient_before)[static_cast<Eigen::Index>(axis)];
        ASSERT_GE(changed, change[axis].low - 1e-12) << i;
        ASSERT_LE(changed, change[axis].high + 1e-12) << i;
      }
      before = p;
      gradient_before = gradient;
    }
  }
}

TEST(ImplicitFunction, ListsOfEightAreTheSameNumbers) {
  test::Random random(5);
  for (int i = 0; i < 300; ++i) {
    const ImplicitFunction function(test::randomSolid(random));
    std::array<Lanes, 3> points;
    std::array<Vec3, 8> each;
    for (std::size_t n = 0; n < 8; ++n) {
      each[n] = random.inCube(0.03);
      for (std::size_t axis = 0; axis < 3; ++axis) points[axis].of[n] = each[n][static_cast<Eigen::Index>(axis)];
    }
    for (const SmoothFunction& sheet : function.sheets()) {
      const Lanes values = sheet.at(points);
      for (std::size_t n = 0; n < 8; ++n) ASSERT_EQ(values.of[n], sheet.at(each[n]));
    }
  }
}

TEST(Expression, RefusesWhatCannotBeAndSaysWhere) {
  const auto refusal = [](const Expression& expression) -> std::string {
    try {
      ImplicitFunction function(expression);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  using K = ExpressionKind;
  EXPECT_EQ(refusal(test::sphere(0)), "sphere.radius must be from 1e-9 to 1e6");
  EXPECT_EQ(refusal(test::sphere(NAN)), "sphere.radius must be from 1e-9 to 1e6");
  EXPECT_EQ(refusal(test::of(K::kUnion, {test::sphere(1), test::box(Vec3(1, -1, 1))})),
            "union.of[1].box.size must be from 1e-9 to 1e6");
  EXPECT_EQ(refusal(test::torus(1, 1)), "torus.tube must be less than its radius");
  EXPECT_EQ(refusal(test::of(K::kUnion, {})), "union.of must be a list of expressions");
  EXPECT_EQ(refusal(test::of(K::kDifference, {})), "difference.of must be a list of expressions");
  EXPECT_EQ(refusal(test::halfSpace(Vec3::Zero())), "halfSpace.normal must be a direction that is not 0");
  Expression deep = test::sphere(1);
  for (int i = 0; i < 30; ++i) deep = test::changed(K::kOffset, deep, 0.01);
  EXPECT_NE(refusal(deep).find("more than 24 parts in each other"), std::string::npos);
  std::vector<Expression> boxes(11, test::box(Vec3::Ones()));
  EXPECT_NE(refusal(test::of(K::kUnion, boxes)).find("more than 64 smooth surfaces"), std::string::npos);
  EXPECT_NE(refusal(test::of(K::kUnion, {test::of(K::kUnion, {boxes[0], boxes[1]}), boxes[2]}, 0.1))
                .find("more smooth surfaces than 64"),
            std::string::npos);
}

}  // namespace
}  // namespace hl::test_implicit_function
