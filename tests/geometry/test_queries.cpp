// The exact queries: the same bits through each hierarchy and by brute force, whatever the order of the primitives.
#include "geometry/queries.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>

#include "cases.h"
#include "geometry/brute_force.h"
#include "geometry/scenes.h"
#include "geometry/sphere_tree.h"
#include "geometry/wide_bvh.h"
#include "guard/realtime_guard.h"

namespace hl::test_queries {
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

// One scene and its indices, asked in a given order of the primitives.
struct Asked {
  std::vector<Primitive> scene;
  SphereTree spheres;
  WideBvh boxes;
  BruteForceIndex brute;
  explicit Asked(std::vector<Primitive> primitives)
      : scene(std::move(primitives)),
        spheres(SphereTree::build(scene)),
        boxes(WideBvh::build(scene)),
        brute(scene.size()) {}
  std::array<const SpatialIndex*, 2> hierarchies() const { return {&spheres, &boxes}; }
  std::array<const SpatialIndex*, 3> all() const { return {&spheres, &boxes, &brute}; }
};

using Near = std::map<std::uint32_t, double>;  // source -> distance

Near nearBy(const SpatialIndex& index, const Asked& asked, const Query& query) {
  Near near;
  primitivesWithin(index, asked.scene, query.from, query.radius, [&](std::uint32_t i, const ClosestPoint& nearest) {
    near[asked.scene[i].source] = nearest.distance;
  });
  return near;
}

bool firstBy(const SpatialIndex& index, const Asked& asked, const Query& query, FirstImpact& out) {
  return firstImpact(index, asked.scene, query.from, query.motion, query.radius, query.touching, out);
}

struct Nearest {
  double distance;
  std::uint64_t source;
  bool operator==(const Nearest&) const = default;
};

// Of several at the same distance the first by precedes().
Nearest nearestBy(const SpatialIndex& index, const Asked& asked, const Vec3& from, double farthest) {
  const Primitive* nearest = nullptr;
  double distance = farthest;
  index.nearest(from, farthest, [&](ElementId i, double limit) {
    EXPECT_EQ(limit, distance);
    const double here = closestPoint(asked.scene[i], from).distance;
    if (here > distance || (nearest != nullptr && here == distance && !precedes(asked.scene[i], *nearest)))
      return limit;
    nearest = &asked.scene[i];
    return distance = here;
  });
  return {distance, nearest != nullptr ? nearest->source : ~std::uint64_t{0}};
}

void compare(const Asked& asked, const Asked& shuffled, const Query& query, int& hits) {
  FirstImpact by_brute;
  const bool hit = firstBy(asked.brute, asked, query, by_brute);
  if (hit) ++hits;
  const Near near = nearBy(asked.brute, asked, query);
  const double farthest = query.touching > 0 ? query.radius : std::numeric_limits<double>::infinity();
  const Nearest nearest = nearestBy(asked.brute, asked, query.from, farthest);
  for (const Asked* order : {&asked, &shuffled}) {
    for (const SpatialIndex* hierarchy : order->hierarchies()) {
      FirstImpact by_hierarchy;
      ASSERT_EQ(firstBy(*hierarchy, *order, query, by_hierarchy), hit);
      ASSERT_EQ(nearBy(*hierarchy, *order, query), near);
      ASSERT_EQ(nearestBy(*hierarchy, *order, query.from, farthest), nearest);
      if (!hit) continue;
      ASSERT_TRUE(sameBits(by_hierarchy.impact, by_brute.impact));
      ASSERT_EQ(order->scene[by_hierarchy.primitive].source, asked.scene[by_brute.primitive].source);
    }
  }
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
    if (!makeTriangle(a, b, c, source, primitive) && !test::makeSegment(a, b, source, primitive))
      test::makePoint(a, source, primitive);
    scene.push_back(primitive);
  }
  const Asked asked(std::move(scene));
  const Vec3 from = vec(), motion = vec();
  const double radius = 0.25 * *rc::gen::inRange(1, 8), touching = *rc::gen::inRange(0, 2) * radius;
  const Query query{from, motion, radius, touching};
  FirstImpact by_brute;
  const bool hit = firstBy(asked.brute, asked, query, by_brute);
  for (const SpatialIndex* hierarchy : asked.hierarchies()) {
    FirstImpact by_hierarchy;
    RC_ASSERT(firstBy(*hierarchy, asked, query, by_hierarchy) == hit);
    if (!hit) continue;
    RC_ASSERT(sameBits(by_hierarchy.impact, by_brute.impact));
    RC_ASSERT(by_hierarchy.primitive == by_brute.primitive);
  }
}

void compareScene(std::vector<Primitive> scene, int queries, double cube, double size, std::uint64_t seed,
                  const Vec3& place = Vec3::Zero()) {
  test::Random random(seed);
  std::vector<Primitive> mixed = scene;
  std::shuffle(mixed.begin(), mixed.end(), random.engine());
  const Asked asked(std::move(scene));
  const Asked shuffled(std::move(mixed));
  int hits = 0;
  queries = test::cases(queries);
  for (int i = 0; i < queries; ++i) {
    Query query = randomQuery(random, cube, size);
    query.from += place;
    compare(asked, shuffled, query, hits);
    if (::testing::Test::HasFatalFailure()) FAIL() << "query " << i;
  }
  EXPECT_GT(hits, queries / 100);
}

TEST(Queries, HierarchiesAndBruteForceAgreeToTheBitInASoupInAnyOrder) {
  test::Random random(41);
  compareScene(test::soup(random, 300, 1, 0.2), 60'000, 1, 0.2, 42);
}

TEST(Queries, HierarchiesAndBruteForceAgreeToTheBitAtSmallAndLargeScales) {
  test::Random random(43);
  compareScene(test::soup(random, 300, 1e-5, 2e-6), 20'000, 1e-5, 2e-6, 44);
  compareScene(test::soup(random, 300, 1e6, 1e3), 20'000, 1e6, 3e5, 45);
}

TEST(Queries, HierarchiesAndBruteForceAgreeToTheBitOnASheetWhereEveryEdgeIsShared) {
  compareScene(test::terrain(16), 20'000, 0.7, 0.1, 46);
}

TEST(Queries, HierarchiesAndBruteForceAgreeToTheBitFarFromTheOrigin) {
  test::Random random(49);
  std::vector<Primitive> scene;
  const Vec3 place(3e5, -7e5, 2e5);
  for (const Primitive& near : test::soup(random, 300, 1, 0.2)) {
    const auto& v = near.vertex;
    Primitive far;
    const bool made = near.kind == PrimitiveKind::kPoint ? test::makePoint(v[0] + place, near.source, far)
                      : near.kind == PrimitiveKind::kSegment
                          ? test::makeSegment(v[0] + place, v[1] + place, near.source, far)
                          : makeTriangle(v[0] + place, v[1] + place, v[2] + place, near.source, far);
    if (made) scene.push_back(far);
  }
  compareScene(std::move(scene), 20'000, 1, 0.2, 50, place);
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

// Each search that is to stop after so many visits those that the whole search visits first, and no more.
TEST(Queries, ASearchThatIsToStopStops) {
  test::Random random(49);
  int stopped = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const Asked asked(test::soup(random, 300, 1, 0.3));
    for (int i = 0; i < 200; ++i) {
      const Query query = randomQuery(random, 0.5, 0.1);
      const auto most = static_cast<std::size_t>(1 + random.below(9));
      for (const SpatialIndex* index : asked.all()) {
        std::vector<ElementId> all, few;
        const std::size_t whole = index->overlap(query.from, query.radius, [&](ElementId id) { all.push_back(id); });
        const std::size_t cost = index->overlapUntil(query.from, query.radius, [&](ElementId id) {
          few.push_back(id);
          return few.size() == most;
        });
        EXPECT_LE(cost, whole);
        stopped += few.size() < all.size();
        all.resize(std::min(all.size(), most));
        ASSERT_EQ(few, all);
      }
    }
  }
  EXPECT_GT(stopped, 5'000);
}

TEST(Queries, NothingIsAllocated) {
  const Asked asked(test::terrain(20));
  test::Random random(48);
  for (int i = 0; i < 1000; ++i) {
    const Query query = randomQuery(random, 0.5, 0.1);
    std::size_t near = 0;
    FirstImpact impact;
    const RealtimeGuard guard;
    for (const SpatialIndex* hierarchy : asked.hierarchies()) {
      firstBy(*hierarchy, asked, query, impact);
      primitivesWithin(*hierarchy, asked.scene, query.from, query.radius,
                       [&](std::uint32_t, const ClosestPoint&) { ++near; });
    }
  }
}

}  // namespace
}  // namespace hl::test_queries
