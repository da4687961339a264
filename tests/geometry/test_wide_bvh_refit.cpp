// A refitted hierarchy: whatever its primitives have done, it answers as a rebuilt one and as brute force, to the bit;
// and it knows how much worse it has become.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>

#include "geometry/brute_force.h"
#include "geometry/queries.h"
#include "geometry/scenes.h"
#include "geometry/wide_bvh.h"

namespace hl::test_wide_bvh_refit {
namespace {

using test::Mesh;

using Movement = std::function<Vec3(const Vec3&)>;

Mesh moved(Mesh mesh, const Movement& movement) {
  for (Vec3& position : mesh.positions) position = movement(position);
  return mesh;
}

// Triangles, segments and points of mixed sizes in a cube of 2 m, with vertices of their own.
Mesh mixedMesh(test::Random& random, int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10.0, random.uniform(-2, -0.3));
    const Vec3 at = random.inCube(1);
    const std::uint32_t a = mesh.add(at), b = mesh.add(at + random.inCube(size)),
                        c = mesh.add(at + random.inCube(size));
    const int kind = random.below(8);
    if (kind > 1) mesh.triangles.push_back({a, b, c});
    if (kind == 1) mesh.segments.push_back({a, b});
    if (kind == 0) mesh.points.push_back(c);
  }
  return mesh;
}

Mesh sheet(int cells) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) mesh.add(Vec3(i, j, std::sin(0.3 * i) * std::cos(0.2 * j)) / cells);
  }
  for (std::uint32_t a = 0; a + n < n * n; ++a) {
    if (a % n == n - 1) continue;
    mesh.triangles.push_back({a, a + n, a + n + 1});
    mesh.triangles.push_back({a, a + n + 1, a + 1});
  }
  return mesh;
}

// What a mesh may do from one frame to the next, and far more.
std::vector<Movement> movements(test::Random& random) {
  const Mat3 turn = Eigen::AngleAxisd(1, random.direction()).toRotationMatrix();
  const Vec3 far = 1e8 * random.direction();
  return {[](const Vec3& p) { return p; },
          [&](const Vec3& p) { return Vec3(p + random.inCube(0.01)); },
          [&](const Vec3&) { return random.inCube(1); },
          [&](const Vec3& p) { return Vec3(p + std::pow(10.0, random.uniform(-6, 8)) * random.direction()); },
          [=](const Vec3& p) { return Vec3(turn * p + far); },
          [](const Vec3& p) { return Vec3(1e-7 * p); },
          [](const Vec3& p) { return Vec3(1e8 * p); },
          [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.5); },
          [&](const Vec3& p) { return random.below(100) == 0 ? Vec3(1e9 * random.inCube(1)) : p; }};
}

bool sameBytes(const WideBvh& a, const WideBvh& b) {
  return std::equal(a.nodes().begin(), a.nodes().end(), b.nodes().begin(), b.nodes().end(),
                    [](const WideNode& x, const WideNode& y) { return std::memcmp(&x, &y, sizeof(x)) == 0; }) &&
         std::equal(a.blocks().begin(), a.blocks().end(), b.blocks().begin(), b.blocks().end(),
                    [](const WideBlock& x, const WideBlock& y) { return std::memcmp(&x, &y, sizeof(x)) == 0; });
}

struct Query {
  Vec3 from, motion;
  double radius;
};

// Near one of the primitives, at about its scale.
Query randomQuery(test::Random& random, const Primitives& primitives) {
  const Primitive near = primitives[static_cast<std::size_t>(random.below(static_cast<int>(primitives.size())))];
  const double size = (near.vertex[1] - near.vertex[0]).norm() + 1e-3 * near.vertex[0].norm() + 1e-6;
  return {near.vertex[0] + 3 * size * random.inCube(1), 6 * size * random.inCube(1),
          size * std::pow(10.0, random.uniform(-2, 0.3))};
}

struct Answers {
  bool hit = false;
  FirstImpact first;
  std::map<std::uint32_t, double> near;  // primitive -> distance
};

Answers ask(const SpatialIndex& index, const Primitives& primitives, const Query& query) {
  Answers answers;
  answers.hit = firstImpact(index, primitives, query.from, query.motion, query.radius, 0, answers.first);
  primitivesWithin(index, primitives, query.from, query.radius,
                   [&](ElementId primitive, const ClosestPoint& at) { answers.near[primitive] = at.distance; });
  return answers;
}

bool operator==(const Answers& a, const Answers& b) {
  const Impact &x = a.first.impact, &y = b.first.impact;
  if (a.hit != b.hit || a.near != b.near) return false;
  return !a.hit || (a.first.primitive == b.first.primitive && x.t == y.t && x.feature == y.feature &&
                    x.normal == y.normal && x.weights == y.weights);
}

void compare(const WideBvh& refitted, const Primitives& primitives, test::Random& random, int queries) {
  const WideBvh rebuilt = WideBvh::build(primitives);
  const BruteForceIndex brute(primitives.size());
  for (int i = 0; i < queries; ++i) {
    const Query query = randomQuery(random, primitives);
    const Answers expected = ask(brute, primitives, query);
    ASSERT_TRUE(ask(refitted, primitives, query) == expected) << i;
    ASSERT_TRUE(ask(rebuilt, primitives, query) == expected) << i;
  }
}

RC_GTEST_PROP(WideBvhRefit, AnswersAreThoseOfARebuiltOneAndOfBruteForce, (std::uint64_t seed)) {
  test::Random random(seed);
  const Mesh mesh = mixedMesh(random, *rc::gen::inRange(1, 400));
  const Primitives before = mesh.primitives();
  const WideBvh built = WideBvh::build(before);
  WideBvh chain = built;
  for (const Movement& movement : movements(random)) {
    const Mesh now = moved(mesh, movement);
    const Primitives primitives = now.primitives();
    if (primitives.size() != before.size()) continue;  // some are no primitives there
    compare(built.refit(primitives), primitives, random, 60);
    chain = chain.refit(primitives);
    RC_ASSERT(sameBytes(chain, built.refit(primitives)));
  }
}

TEST(WideBvhRefit, WhatHasNotMovedKeepsEveryByte) {
  test::Random random(81);
  for (const Mesh& mesh : {mixedMesh(random, 3000), sheet(60), moved(sheet(40), movements(random)[4])}) {
    const Primitives primitives = mesh.primitives();
    const WideBvh built = WideBvh::build(primitives);
    const WideBvh refitted = built.refit(primitives);
    EXPECT_TRUE(sameBytes(refitted, built));
    EXPECT_EQ(refitted.cost(), built.cost());
    EXPECT_EQ(refitted.costRatio(), 1);
    EXPECT_EQ(refitted.stats().depth, built.stats().depth);
    EXPECT_EQ(refitted.origin(), built.origin());
  }
}

TEST(WideBvhRefit, TheNumberOfThreadsDoesNotChangeAByte) {
  test::Random random(82);
  const Mesh mesh = sheet(160), now = moved(mesh, movements(random)[1]);
  const Primitives primitives = now.primitives();
  const WideBvh built = WideBvh::build(mesh.primitives());
  const WideBvh many = built.refit(primitives);
  for (const std::size_t threads : {1, 2, 3}) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    const WideBvh refitted = built.refit(primitives);
    EXPECT_TRUE(sameBytes(refitted, many)) << threads;
    EXPECT_EQ(refitted.cost(), many.cost()) << threads;
  }
}

TEST(WideBvhRefit, FewPrimitivesAndThoseWithoutAreaOrLengthWork) {
  test::Random random(83);
  for (const int count : {1, 2, 8, 9, 100}) {
    Mesh points, segments;
    for (int i = 0; i < count; ++i) {
      points.points.push_back(points.add(random.inCube(1)));
      segments.segments.push_back({segments.add(random.inCube(1)), segments.add(random.inCube(1))});
    }
    for (const Mesh& mesh : {points, segments}) {
      const WideBvh built = WideBvh::build(mesh.primitives());
      for (const Movement& movement : movements(random)) {
        const Mesh now = moved(mesh, movement);
        compare(built.refit(now.primitives()), now.primitives(), random, 100);
      }
    }
    const Mesh one_place = moved(points, [](const Vec3&) { return Vec3(1, 2, 3); });
    compare(WideBvh::build(points.primitives()).refit(one_place.primitives()), one_place.primitives(), random, 100);
  }
  EXPECT_EQ(WideBvh::build({}).refit({}).primitives(), 0u);
}

TEST(WideBvhRefit, WearStaysLowWhereAMeshBendsAndGrowsWhereItIsShuffled) {
  const Mesh mesh = sheet(100);
  const WideBvh built = WideBvh::build(mesh.primitives());
  EXPECT_EQ(built.costRatio(), 1);
  EXPECT_GT(built.cost(), 1);
  const auto costRatioOf = [&](const Movement& movement) {
    const Mesh now = moved(mesh, movement);
    return built.refit(now.primitives()).costRatio();
  };
  EXPECT_NEAR(costRatioOf([](const Vec3& p) { return Vec3(10 * p + Vec3(3, 4, 5)); }), 1, 1e-3);
  EXPECT_LT(costRatioOf([](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() + 0.02 * std::sin(20 * p.x())); }), 1.5);
  test::Random random(84);
  EXPECT_GT(costRatioOf([&](const Vec3&) { return random.inCube(0.5); }), 20);
}

TEST(WideBvhRefit, ARowOfPointsCanBeJudgedToo) {
  Mesh mesh;
  for (int i = 0; i < 1000; ++i) mesh.points.push_back(mesh.add(Vec3(i, 0, 0)));
  const WideBvh built = WideBvh::build(mesh.primitives());
  test::Random random(85);
  const Mesh now = moved(mesh, [&](const Vec3&) { return Vec3(random.uniform(0, 1000), 0, 0); });
  EXPECT_GT(built.refit(now.primitives()).costRatio(), 5);
}

}  // namespace
}  // namespace hl::test_wide_bvh_refit
