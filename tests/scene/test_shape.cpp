// Shapes that follow on others: refitted where only vertices have moved, built where anything else has changed.
#include "scene/shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/queries.h"
#include "geometry/scenes.h"

namespace hl::test_shape {
namespace {

Model sheet(std::uint32_t cells) {
  Model model;
  const std::uint32_t n = cells + 1;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) model.positions.emplace_back(i, j, 0.3 * std::sin(i + j));
  }
  for (std::uint32_t a = 0; a + n < n * n; ++a) {
    if (a % n == n - 1) continue;
    model.triangles.push_back({a, a + n, a + n + 1});
    model.triangles.push_back({a, a + n + 1, a + 1});
  }
  model.segments.push_back({0, n * n - 1});
  model.points.push_back(n);
  return model;
}

Model shaken(Model model, double by, std::uint64_t seed) {
  test::Random random(seed);
  for (Vec3& position : model.positions) position += random.inCube(by);
  return model;
}

// Where a sphere that falls anywhere on them stops, and on what.
void expectSameAnswers(const Shape& a, const Shape& b) {
  test::Random random(5);
  ASSERT_EQ(a.primitives.size(), b.primitives.size());
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from(random.uniform(0, 20), random.uniform(0, 20), 40), motion(random.uniform(-5, 5), 0, -80);
    FirstImpact by_a, by_b;
    const bool hit = firstImpact(*a.index, a.primitives, from, motion, 0.2, 0, by_a);
    ASSERT_EQ(firstImpact(*b.index, b.primitives, from, motion, 0.2, 0, by_b), hit);
    if (!hit) continue;
    ASSERT_EQ(by_a.primitive, by_b.primitive);
    ASSERT_EQ(by_a.impact.t, by_b.impact.t);
    ASSERT_EQ(by_a.impact.normal, by_b.impact.normal);
  }
}

TEST(Shape, IsRefittedWhereOnlyVerticesHaveMoved) {
  auto before = makeShape(sheet(20));
  EXPECT_EQ(before->before, 0u);
  for (const double by : {0.0, 0.1, 0.4, 30.0}) {
    const Model moved = shaken(sheet(20), by, 1);  // triangles are turned anew: their smallest vertices are others
    const auto refitted = makeShape(Model(moved), *before);
    EXPECT_EQ(refitted->before, before->geometry);
    EXPECT_NE(refitted->geometry, before->geometry);
    const auto built = makeShape(Model(moved));
    EXPECT_EQ(refitted->model.triangles, built->model.triangles);
    EXPECT_EQ(refitted->bounds.min, built->bounds.min);
    EXPECT_EQ(refitted->bounds.max, built->bounds.max);
    expectSameAnswers(*refitted, *built);
    before = refitted;
  }
  EXPECT_GT(before->cost_ratio, kMaxCostRatio);
  const auto anew = rebuilt(*before);
  EXPECT_EQ(anew->geometry, before->geometry);
  EXPECT_EQ(anew->cost_ratio, 1);
  EXPECT_EQ(anew->before, 0u);
  expectSameAnswers(*anew, *before);
}

TEST(Shape, IsBuiltWhereItsListsHaveChanged) {
  const Model model = sheet(20);
  const auto before = makeShape(Model(model));
  std::vector<Model> others(7, model);
  std::swap(others[0].triangles[3][0], others[0].triangles[3][1]);
  std::swap(others[1].triangles[3], others[1].triangles[4]);
  others[2].triangles.pop_back();
  others[3].segments[0][0] = 1;
  others[4].points[0] = 2;
  others[5].positions.emplace_back(0, 0, 0);
  others[6].positions[0] = others[6].positions[1];  // makes a triangle degenerate
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto shape = makeShape(Model(others[i]), *before);
    EXPECT_EQ(shape->before, 0u) << i;
    expectSameAnswers(*shape, *makeShape(Model(others[i])));
  }
}

TEST(Shape, IsBuiltWhereOtherElementsAreSkippedAndRefittedWhereTheSameAre) {
  Model model = sheet(20);
  model.positions[0] = model.positions[1];
  const auto before = makeShape(Model(model));
  EXPECT_FALSE(before->warnings.empty());
  Model bent = model;
  bent.positions[70].z() += 0.2;
  const auto refitted = makeShape(Model(bent), *before);
  EXPECT_EQ(refitted->before, before->geometry);
  expectSameAnswers(*refitted, *makeShape(Model(bent)));
  bent.positions[300] = bent.positions[301];
  EXPECT_EQ(makeShape(Model(bent), *before)->before, 0u);
  EXPECT_EQ(makeShape(sheet(20), *before)->before, 0u);
}

TEST(Shape, KeepsTheKindOfItsHierarchy) {
  for (const HierarchyKind kind : {HierarchyKind::kSpheres, HierarchyKind::kNone}) {
    const auto before = makeShape(sheet(20), kind);
    const Model moved = shaken(sheet(20), 0.3, 2);
    const auto after = makeShape(Model(moved), *before);
    EXPECT_EQ(after->before, 0u);
    EXPECT_EQ(after->hierarchy, kind);
    expectSameAnswers(*after, *makeShape(Model(moved)));
  }
}

}  // namespace
}  // namespace hl::test_shape
