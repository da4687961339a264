// Where a proxy begins whose finger is inside something: near the finger, or wherever there is room about it.
#include "proxy/start_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "geometry/scenes.h"
#include "judge.h"
#include "moving_scenes.h"

namespace hl::test_start_search {
namespace {

constexpr double kRadius = 1e-3;

struct Found {
  bool clear = false;
  int looks = 0;
  Vec3 place = Vec3::Zero();
};

// So many places at each look, until one is clear or all have been looked at.
Found searchIn(const Snapshot& scene, const Vec3& finger, int places, StartSearch& search) {
  const auto tolerance = Tolerances::of(kRadius, scene.extent);
  Found found;
  while (!found.clear && found.looks * places < StartSearch::kPlaces) {
    found.clear = search.look(scene, tolerance, finger, places, found.place);
    ++found.looks;
  }
  return found;
}
Found searchIn(const Snapshot& scene, const Vec3& finger, int places = StartSearch::kPlaces) {
  StartSearch search;
  return searchIn(scene, finger, places, search);
}

// Plates all over, so near to one another that nothing has room between them.
std::shared_ptr<const Snapshot> stack(double half, double step) {
  std::vector<std::array<Vec3, 3>> plates;
  for (double y = -half; y <= half; y += step)
    plates.push_back({Vec3(-4 * half, y, -2 * half), Vec3(4 * half, y, -2 * half), Vec3(0, y, 4 * half)});
  return judge::scene(judge::triangles(plates));
}

TEST(StartSearch, InTheOpenItIsTheFingerToTheBit) {
  const auto scene = judge::scene(judge::triangles({{Vec3(0.1, -1, -1), Vec3(0.1, 1, -1), Vec3(0.1, 0, 1)}}));
  const Vec3 finger(0.01, 1.0 / 3, 0);
  const Found found = searchIn(*scene, finger);
  EXPECT_TRUE(found.clear);
  EXPECT_EQ(found.place, finger);
}

TEST(StartSearch, ATouchingFingerIsPushedOutOnItsSide) {
  const auto scene = judge::scene(judge::triangles({{Vec3(0.1, -1, -1), Vec3(0.1, 1, -1), Vec3(0.1, 0, 1)}}));
  const Found found = searchIn(*scene, {0.1 - 0.2 * kRadius, 0, 0});
  EXPECT_TRUE(found.clear);
  EXPECT_NEAR((found.place - Vec3(0.1 - kRadius, 0, 0)).norm(), 0, 1e-8);
}

// Within a wall too thin for the proxy, to the side that is nearer, at the second place of all.
TEST(StartSearch, WithinAThinWallItIsBeyondTheNearerSide) {
  const double half = 0.4 * kRadius;
  const auto scene = makeSnapshot({test::place(1, test::boxModel({0.05, half, 0.05}), Motion())});
  for (const double side : {-1.0, 1.0}) {
    const Found found = searchIn(*scene, {0.003, 0.1 * side * half, 0.002}, 1);
    ASSERT_TRUE(found.clear);
    EXPECT_EQ(found.looks, 2);
    EXPECT_NEAR((found.place - Vec3(0.003, side * (half + kRadius), 0.002)).norm(), 0, 1e-7);
  }
}

TEST(StartSearch, AllAtOnceOrAFewInEachTickItFindsTheSamePlace) {
  test::Random random(3);
  int later = 0;
  for (int i = 0; i < 30; ++i) {
    std::vector<Instance> boxes;
    for (std::uint64_t key = 1; key <= 12; ++key)
      boxes.push_back(test::place(key, test::boxModel(Vec3::Constant(random.uniform(0.5, 3) * kRadius)),
                                  Motion(test::at(random.inCube(2 * kRadius)))));
    const auto scene = makeSnapshot(boxes);
    const Vec3 finger = random.inCube(kRadius);
    const Found whole = searchIn(*scene, finger);
    ASSERT_TRUE(whole.clear);
    ASSERT_GE(judge::clearance(*scene, whole.place, 2 * kRadius), kRadius) << i;
    for (const int places : {1, 2, 7}) {
      const Found some = searchIn(*scene, finger, places);
      ASSERT_TRUE(some.clear);
      ASSERT_EQ(some.place, whole.place) << i;
      later += some.looks > 3 ? 1 : 0;
    }
  }
  EXPECT_GT(later, 10);
}

// A stack of plates higher than the search reaches has no room; one that is lower has, beyond it.
TEST(StartSearch, ItLooksAsFarAsItSaysAndBeginsAnew) {
  const double step = 1.5 * kRadius;
  const auto endless = stack(1.1 * convergence::kFarthestStart * kRadius, step);
  StartSearch search;
  const Vec3 finger(0, 0.3 * kRadius, 0);
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(searchIn(*endless, finger, StartSearch::kPlaces, search).clear);
  const auto low = stack(0.8 * convergence::kFarthestStart * kRadius, step);
  const Found first = searchIn(*low, finger, StartSearch::kPlaces, search);
  ASSERT_TRUE(first.clear);
  const double reach = Tolerances::of(kRadius, low->extent).reach;
  EXPECT_LE((first.place - finger).norm(), convergence::kFarthestStart * reach * (1 + 1e-12));
  EXPECT_EQ(searchIn(*low, finger, StartSearch::kPlaces, search).place, first.place);
}

}  // namespace
}  // namespace hl::test_start_search
