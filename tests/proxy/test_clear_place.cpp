// A sphere that overlaps the scene is pushed out of it, and its centre never crosses a surface.
#include "proxy/clear_place.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/scenes.h"
#include "judge.h"

namespace hl::test_clear_place {
namespace {

constexpr double kRadius = 1e-3;

Tolerances toleranceIn(const Snapshot& scene) { return Tolerances::of(kRadius, scene.extent); }

std::vector<std::array<Vec3, 3>> soup(test::Random& random, int count, double half) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = random.inCube(half);
    triangles.push_back({middle + random.inCube(half), middle + random.inCube(half), middle + random.inCube(half)});
  }
  return triangles;
}

TEST(ClearPlace, WhereItIsClearItStaysToTheBit) {
  const auto scene = judge::scene(judge::triangles({{Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(0, 0, 1)}}));
  for (const double height : {1.0, 1.1, 40.0}) {
    const Vec3 from(0.1, height * toleranceIn(*scene).reach, 0.2);
    Vec3 place = from;
    EXPECT_TRUE(findClearPlace(*scene, toleranceIn(*scene), 1, place));
    EXPECT_EQ(place, from);
  }
}

// Between three walls that meet: out of all of them at once.
TEST(ClearPlace, OutOfAnInnerCornerItGoesTheWholeWay) {
  const auto scene = judge::scene(judge::triangles({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                                                    {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                                    {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)}}));
  Vec3 place = kRadius * Vec3(0.1, 0.3, 0.2);
  ASSERT_TRUE(findClearPlace(*scene, toleranceIn(*scene), 8, place));
  EXPECT_NEAR((place - Vec3::Constant(kRadius)).norm(), 0, 1e-8);
}

TEST(ClearPlace, WhereThereIsNoRoomItSaysSo) {
  const auto scene =
      judge::scene(judge::triangles({{Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(0, 0, 1)},
                                     {Vec3(-1, kRadius, -1), Vec3(1, kRadius, -1), Vec3(0, kRadius, 1)}}));
  Vec3 place(0, 0.3 * kRadius, 0);
  EXPECT_FALSE(findClearPlace(*scene, toleranceIn(*scene), 20, place));
  EXPECT_GT(place.y(), 0);
  EXPECT_LT(place.y(), kRadius);
}

// One try goes straight, so whether it has crossed a surface is seen.
RC_GTEST_PROP(ClearPlace, EachTryGoesARadiusAtMostAndCrossesNothing, (std::uint64_t seed)) {
  test::Random random(seed);
  const auto scene = judge::scene(judge::triangles(soup(random, 1 + random.below(20), 3 * kRadius)));
  const Tolerances tolerance = toleranceIn(*scene);
  Vec3 place = random.inCube(3 * kRadius);
  for (int i = 0; i < 10; ++i) {
    const Vec3 before = place;
    const bool clear = findClearPlace(*scene, tolerance, 1, place);
    RC_ASSERT((place - before).norm() <= tolerance.reach * (1 + 1e-12));
    SceneImpact impact;
    if (place != before) RC_ASSERT(!SceneAt(*scene).firstImpact(before, place - before, 1e-12, -1, impact));
    if (!clear) continue;
    RC_ASSERT(place == before);
    RC_ASSERT(judge::clearance(*scene, place, 2 * kRadius) >= kRadius);
    return;
  }
}

RC_GTEST_PROP(ClearPlace, TheClearanceIsTheLeastDistanceOfAllTriangles, (std::uint64_t seed)) {
  test::Random random(seed);
  const auto triangles = soup(random, 1 + random.below(20), 3 * kRadius);
  const auto scene = judge::scene(judge::triangles(triangles));
  const Vec3 place = random.inCube(6 * kRadius);
  const double most = random.uniform(0, 6) * kRadius;
  double least = most;
  for (const auto& t : triangles) {
    Primitive triangle;
    RC_PRE(makeTriangle(t[0], t[1], t[2], 0, triangle));
    least = std::min(least, closestPoint(triangle, place).distance);
  }
  RC_ASSERT(clearanceAt(*scene, place, most) == least);
}

}  // namespace
}  // namespace hl::test_clear_place
