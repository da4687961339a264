// The index of a iso surface against the hierarchy over the same triangles as a mesh: the same answers bit for bit.
#include "surfaces/brick_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/realtime_guard.h"
#include "geometry/queries.h"
#include "geometry/wide_bvh.h"
#include "volumes.h"

namespace hl {
namespace {

using test::Random;

// A field, and its judge.
struct Pair {
  explicit Pair(std::shared_ptr<const IsoSurface> given)
      : field(std::move(given)),
        index(field->cells(), field->bounds()),
        mesh(test::meshOf(*field)),
        primitives(mesh.view()),
        bvh(WideBvh::build(primitives)) {}

  bool impact(const Vec3& from, const Vec3& motion, double radius, double touching, bool of_mesh, FirstImpact& out,
              Primitive& hit) const {
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*field, id); };
    const bool found = of_mesh ? hl::firstImpact(bvh, primitives, from, motion, radius, touching, out)
                               : hl::firstImpact(index, read, from, motion, radius, touching, out);
    if (found) hit = of_mesh ? primitives[out.primitive] : primitiveOf(*field, out.primitive);
    return found;
  }

  std::shared_ptr<const IsoSurface> field;
  BrickIndex index;
  test::Mesh mesh;
  Primitives primitives;
  WideBvh bvh;
};

using Distances = std::vector<std::array<double, 10>>;  // a distance, and the vertices it is to

Distances sorted(Distances list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

std::array<double, 10> entryOf(const Primitive& primitive, double distance) {
  std::array<double, 10> entry{distance};
  for (std::size_t i = 0; i < 9; ++i) entry[i + 1] = primitive.vertex[i / 3][static_cast<Eigen::Index>(i % 3)];
  return entry;
}

// A place on the field or around it, and a radius: of a part of a cell, or of many.
struct Ball {
  Vec3 centre;
  double radius, cell;
};

Ball randomBall(Random& random, const IsoSurface& surface) {
  const GridFrame& frame = surface.frame();
  const VoxelGrid& grid = surface.volume()->grid;
  const auto along = [&](std::size_t axis) { return random.uniform(-2, grid.cells(axis) + 2.0); };
  const double cell = std::cbrt(std::abs(frame.axes.determinant()));
  return {frame.point(along(0), along(1), along(2)), cell * std::pow(10.0, random.uniform(-2, 1)), cell};
}

TEST(BrickIndex, FirstImpactsAreThoseOfTheMesh) {
  Random random(1);
  int hits = 0, queries = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const Pair pair(test::randomSurface(random));
    for (int i = 0; i < 300; ++i, ++queries) {
      const Ball ball = randomBall(random, *pair.field);
      const Vec3 motion = ball.cell * std::pow(10.0, random.uniform(-3, 2)) * random.direction();
      const double touching = random.below(2) * ball.radius * random.uniform(1, 1.2);
      FirstImpact a, b;
      Primitive hit_a, hit_b;
      const bool one = pair.impact(ball.centre, motion, ball.radius, touching, false, a, hit_a);
      const bool other = pair.impact(ball.centre, motion, ball.radius, touching, true, b, hit_b);
      ASSERT_EQ(one, other) << "scene " << scene << " query " << i << " t " << (one ? a : b).impact.t;
      if (!one) continue;
      ++hits;
      ASSERT_EQ(a.impact.t, b.impact.t) << "scene " << scene << " query " << i;
      ASSERT_EQ(hit_a.vertex, hit_b.vertex);
    }
  }
  EXPECT_GT(hits, queries / 10);
}

TEST(BrickIndex, WhatIsWithinADistanceIsWhatIsOfTheMesh) {
  Random random(2);
  std::size_t found = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const Pair pair(test::randomSurface(random));
    for (int i = 0; i < 150; ++i) {
      const Ball ball = randomBall(random, *pair.field);
      Distances a, b;
      Primitive last;
      const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*pair.field, id); };
      primitivesWithin(pair.index, read, ball.centre, ball.radius, [&](ElementId id, const ClosestPoint& nearest) {
        a.push_back(entryOf(primitiveOf(*pair.field, id), nearest.distance));
      });
      primitivesWithin(pair.bvh, pair.primitives, ball.centre, ball.radius,
                       [&](ElementId id, const ClosestPoint& nearest) {
                         b.push_back(entryOf(pair.primitives[id], nearest.distance));
                       });
      a = sorted(std::move(a));
      ASSERT_EQ(a, sorted(std::move(b))) << "scene " << scene << " query " << i;
      found += a.size();
    }
  }
  EXPECT_GT(found, 100'000U);
}

TEST(BrickIndex, TheNearestTriangleIsThatOfTheMesh) {
  Random random(3);
  for (int scene = 0; scene < 300; ++scene) {
    const Pair pair(test::randomSurface(random));
    for (int i = 0; i < 100; ++i) {
      Ball ball = randomBall(random, *pair.field);
      ball.centre += std::pow(10.0, random.uniform(-3, 2)) * ball.cell * random.direction();
      const double farthest = random.below(2) == 0 ? INFINITY : 3 * ball.radius;
      double a = INFINITY, b = INFINITY;
      pair.index.nearest(ball.centre, farthest, [&](ElementId id, double limit) {
        a = std::min(a, closestPoint(primitiveOf(*pair.field, id), ball.centre).distance);
        return std::min(limit, a);
      });
      pair.bvh.nearest(ball.centre, farthest, [&](ElementId id, double limit) {
        b = std::min(b, closestPoint(pair.primitives[id], ball.centre).distance);
        return std::min(limit, b);
      });
      if (std::min(a, b) <= farthest) {
        ASSERT_EQ(a, b) << "scene " << scene << " query " << i;
      }
    }
  }
}

// A sphere of 10^6 triangles: few bricks and cells are looked at.
TEST(BrickIndex, AQueryLooksAtFewCells) {
  const auto volume = test::volumeOf({256, 256, 256}, [](const Vec3& at) { return (at - Vec3::Constant(127)).norm(); });
  const IsoSurface surface(volume, test::cubicFrame(0.5e-3), {120, SolidSide::kBelow});
  const BrickIndex index(surface.cells(), surface.bounds());
  Random random(4);
  std::size_t looked = 0, visited = 0, fewest = 1'000'000;
  for (int i = 0; i < 200; ++i) {
    const Vec3 way = random.direction(), above = Vec3::Constant(0.0635) + 0.065 * way;
    FirstImpact impact;
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(surface, id); };
    ASSERT_TRUE(firstImpact(index, read, above, -0.02 * way, 1e-3, 0, impact));
    const Vec3 centre = above - impact.impact.t * 0.02 * way;
    const RealtimeGuard guard;
    std::size_t near = 0;
    looked += index.overlap(centre, 1.0001e-3, [&](ElementId) { ++near; });
    visited += near;
    fewest = std::min(fewest, near);
  }
  RecordProperty("looked", std::to_string(looked / 200));
  RecordProperty("visited", std::to_string(visited / 200));
  EXPECT_GE(fewest, 1U);
  EXPECT_LT(looked / 200, 500U);
  EXPECT_LT(visited / 200, 60U);
}

}  // namespace
}  // namespace hl
