// The exact queries: the same bits through the sphere tree and by brute force, whatever the order of the primitives.
#include "geometry/queries.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "base/no_alloc.h"
#include "geometry/brute_force.h"
#include "geometry/scenes.h"
#include "geometry/sphere_tree.h"

namespace hl {
namespace {

struct Query {
  Vec3 from, motion;
  double radius, touching;
};

Query randomQuery(test::Random& random, double cube, double size) {
  const double reach = size * std::pow(10.0, random.uniform(-2, 1));
  return {random.inCube(1.3 * cube), random.inCube(reach), size * std::pow(10.0, random.uniform(-2, 0.3)),
          random.below(3) == 0 ? size * 0.3 : 0.0};
}

bool sameBits(const Impact& a, const Impact& b) {
  return a.t == b.t && a.feature == b.feature && a.normal == b.normal && a.weights == b.weights;
}

// One scene and its index, asked in a given order of the primitives.
struct Asked {
  std::vector<Primitive> scene;
  SphereTree tree;
  BruteForceIndex brute;
  explicit Asked(std::vector<Primitive> primitives)
      : scene(std::move(primitives)), tree(SphereTree::build(scene)), brute(scene.size()) {}
};

using Near = std::map<std::uint32_t, double>;  // source -> distance

Near nearBy(const SpatialIndex& index, const Asked& asked, const Query& query) {
  Near near;
  primitivesWithin(index, asked.scene, query.from, query.radius, [&](std::uint32_t i, const ClosestPoint& nearest) {
    near[asked.scene[i].source] = nearest.distance;
  });
  return near;
}

void compare(const Asked& asked, const Asked& shuffled, const Query& query, int& hits) {
  FirstImpact by_tree, by_brute, by_shuffled;
  const bool hit =
      firstImpact(asked.brute, asked.scene, query.from, query.motion, query.radius, query.touching, by_brute);
  ASSERT_EQ(firstImpact(asked.tree, asked.scene, query.from, query.motion, query.radius, query.touching, by_tree), hit);
  ASSERT_EQ(
      firstImpact(shuffled.tree, shuffled.scene, query.from, query.motion, query.radius, query.touching, by_shuffled),
      hit);
  if (hit) {
    ++hits;
    ASSERT_TRUE(sameBits(by_tree.impact, by_brute.impact));
    ASSERT_TRUE(sameBits(by_shuffled.impact, by_brute.impact));
    ASSERT_EQ(by_tree.primitive, by_brute.primitive);
    ASSERT_EQ(shuffled.scene[by_shuffled.primitive].source, asked.scene[by_brute.primitive].source);
  }
  const Near near = nearBy(asked.brute, asked, query);
  ASSERT_EQ(nearBy(asked.tree, asked, query), near);
  ASSERT_EQ(nearBy(shuffled.tree, shuffled, query), near);
}

// Whole numbers make ties, shared corners and grazing paths common; a failure shrinks to a few triangles.
RC_GTEST_PROP(Queries, FirstImpactAmongIntegerPrimitivesIsThatOfBruteForce, ()) {
  const auto coordinate = rc::gen::inRange(-4, 5);
  const auto vec = [&] { return Vec3(*coordinate, *coordinate, *coordinate); };
  std::vector<Primitive> scene;
  const int count = *rc::gen::inRange(1, 13);
  for (int i = 0; i < count; ++i) {
    const Vec3 a = vec(), b = vec(), c = vec();
    const auto source = static_cast<std::uint32_t>(scene.size());
    Primitive primitive;
    if (!makeTriangle(a, b, c, source, primitive) && !makeSegment(a, b, source, primitive))
      makePoint(a, source, primitive);
    scene.push_back(primitive);
  }
  const Asked asked(std::move(scene));
  const Vec3 from = vec(), motion = vec();
  const double radius = 0.25 * *rc::gen::inRange(1, 8), touching = *rc::gen::inRange(0, 2) * radius;
  FirstImpact by_tree, by_brute;
  const bool hit = firstImpact(asked.brute, asked.scene, from, motion, radius, touching, by_brute);
  RC_ASSERT(firstImpact(asked.tree, asked.scene, from, motion, radius, touching, by_tree) == hit);
  if (!hit) return;
  RC_ASSERT(sameBits(by_tree.impact, by_brute.impact));
  RC_ASSERT(by_tree.primitive == by_brute.primitive);
}

void compareScene(std::vector<Primitive> scene, int queries, double cube, double size, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Primitive> mixed = scene;
  std::shuffle(mixed.begin(), mixed.end(), random.engine());
  const Asked asked(std::move(scene));
  const Asked shuffled(std::move(mixed));
  int hits = 0;
  for (int i = 0; i < queries; ++i) {
    compare(asked, shuffled, randomQuery(random, cube, size), hits);
    if (::testing::Test::HasFatalFailure()) FAIL() << "query " << i;
  }
  EXPECT_GT(hits, queries / 100);
}

TEST(Queries, TreeAndBruteForceAgreeToTheBitInASoupInAnyOrder) {
  test::Random random(41);
  compareScene(test::soup(random, 300, 1, 0.2), 60'000, 1, 0.2, 42);
}

TEST(Queries, TreeAndBruteForceAgreeToTheBitAtSmallAndLargeScales) {
  test::Random random(43);
  compareScene(test::soup(random, 300, 1e-5, 2e-6), 20'000, 1e-5, 2e-6, 44);
  compareScene(test::soup(random, 300, 1e6, 1e3), 20'000, 1e6, 3e5, 45);
}

TEST(Queries, TreeAndBruteForceAgreeToTheBitOnASheetWhereEveryEdgeIsShared) {
  compareScene(test::terrain(16), 20'000, 0.7, 0.1, 46);
}

TEST(Queries, TiesAreDecidedByTheVertices) {
  // Straight onto a vertex that six triangles of a flat sheet share.
  std::vector<Primitive> scene;
  for (int i = -1; i <= 0; ++i) {
    for (int j = -1; j <= 0; ++j) {
      test::addTriangle(scene, Vec3(i, j, 0), Vec3(i + 1, j, 0), Vec3(i + 1, j + 1, 0));
      test::addTriangle(scene, Vec3(i, j, 0), Vec3(i + 1, j + 1, 0), Vec3(i, j + 1, 0));
    }
  }
  test::Random random(47);
  for (int round = 0; round < 100; ++round) {
    std::shuffle(scene.begin(), scene.end(), random.engine());
    FirstImpact impact;
    ASSERT_TRUE(firstImpact(BruteForceIndex(scene.size()), scene, Vec3(0, 0, 1), Vec3(0, 0, -1), 0.5, 0, impact));
    EXPECT_EQ(impact.impact.t, 0.5);
    EXPECT_EQ(impact.impact.normal, Vec3::UnitZ());
    EXPECT_EQ(scene[impact.primitive].vertex[0], Vec3(-1, -1, 0));
    EXPECT_EQ(scene[impact.primitive].vertex[1], Vec3(-1, 0, 0));
  }
}

TEST(Queries, PrimitivesInContactAtTheStartAreLeftToTheCaller) {
  std::vector<Primitive> scene;
  test::addTriangle(scene, Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0));
  test::addTriangle(scene, Vec3(-1, -1, -3), Vec3(1, -1, -3), Vec3(0, 1, -3));
  const BruteForceIndex index(scene.size());
  FirstImpact impact;
  ASSERT_TRUE(firstImpact(index, scene, Vec3(0, 0, 0.5), Vec3(0, 0, -4), 0.5, 0, impact));
  EXPECT_EQ(impact.primitive, 0u);
  EXPECT_EQ(impact.impact.t, 0);
  ASSERT_TRUE(firstImpact(index, scene, Vec3(0, 0, 0.5), Vec3(0, 0, -4), 0.5, 0.5, impact));
  EXPECT_EQ(impact.primitive, 1u);
  EXPECT_EQ(impact.impact.t, 0.75);
}

TEST(Queries, NothingIsAllocated) {
  const Asked asked(test::terrain(20));
  test::Random random(48);
  for (int i = 0; i < 1000; ++i) {
    const Query query = randomQuery(random, 0.5, 0.1);
    std::size_t near = 0;
    FirstImpact impact;
    const NoAlloc guard;
    firstImpact(asked.tree, asked.scene, query.from, query.motion, query.radius, query.touching, impact);
    primitivesWithin(asked.tree, asked.scene, query.from, query.radius,
                     [&](std::uint32_t, const ClosestPoint&) { ++near; });
  }
}

}  // namespace
}  // namespace hl
