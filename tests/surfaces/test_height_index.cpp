// The index of a height field against the hierarchy over the same triangles as a mesh: the same answers bit for bit.
#include "surfaces/height_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/realtime_guard.h"
#include "fields.h"
#include "geometry/queries.h"
#include "geometry/wide_bvh.h"

namespace hl {
namespace {

using test::Random;

// A field, and its judge.
struct Pair {
  explicit Pair(std::shared_ptr<const HeightField> given)
      : field(std::move(given)),
        own(field->makeIndex()),
        index(*own),
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

  std::shared_ptr<const HeightField> field;
  std::unique_ptr<const SpatialIndex> own;
  const SpatialIndex& index;
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

Ball randomBall(Random& random, const HeightField& field) {
  const GridFrame& frame = field.frame();
  const double column = random.uniform(-2, field.grid().columns() + 1.0),
               row = random.uniform(-2, field.grid().rows() + 1.0);
  const auto within = [](double at, std::uint32_t side) {
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, side - 1.0));
  };
  double value = field.grid().at(within(column, field.grid().columns()), within(row, field.grid().rows()));
  if (std::isnan(value)) value = field.pyramid().lowest();
  const double cell = std::sqrt(frame.axes.col(0).norm() * frame.axes.col(1).norm());
  const double radius = cell * std::pow(10.0, random.uniform(-2, 1.3));
  const Vec3 up = frame.axes.col(0).cross(frame.axes.col(1)).normalized();
  return {frame.point(column, row, value) + random.uniform(-1.5, 1.5) * radius * up, radius, cell};
}

TEST(HeightIndex, FirstImpactsAreThoseOfTheMesh) {
  Random random(1);
  int hits = 0, queries = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const Pair pair(test::randomField(random));
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
  EXPECT_GT(hits, queries / 8);
}

TEST(HeightIndex, WhatIsWithinADistanceIsWhatIsOfTheMesh) {
  Random random(2);
  std::size_t found = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const Pair pair(test::randomField(random));
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

TEST(HeightIndex, TheNearestTriangleIsThatOfTheMesh) {
  Random random(3);
  for (int scene = 0; scene < 300; ++scene) {
    const Pair pair(test::randomField(random));
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

// A smooth slope of 10^6 triangles: few slabs and cells are looked at, however many the ball covers.
TEST(HeightIndex, AQueryLooksAtFewSlabs) {
  const auto field = test::fieldOf(708, 708, 1e-5, [](double i, double j) {
    return 3e-6 * i + 1e-6 * j + 1e-4 * std::sin(0.02 * i) * std::cos(0.015 * j);
  });
  const auto own = field->makeIndex();
  const SpatialIndex& index = *own;
  Random random(4);
  std::size_t looked = 0, visited = 0, fewest = 1'000'000;
  for (int i = 0; i < 200; ++i) {
    const Vec3 above = field->frame().point(random.uniform(150, 550), random.uniform(150, 550), 0) + Vec3(0, 0.01, 0);
    FirstImpact impact;
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*field, id); };
    ASSERT_TRUE(firstImpact(index, read, above, Vec3(0, -0.02, 0), 1e-3, 0, impact));
    const Vec3 centre = above + impact.impact.t * Vec3(0, -0.02, 0);
    const RealtimeGuard guard;
    std::size_t near = 0;
    looked += index.overlap(centre, 1.0001e-3, [&](ElementId) { ++near; });
    visited += near;
    fewest = std::min(fewest, near);
  }
  EXPECT_GE(fewest, 1U);
  EXPECT_LT(looked / 200, 600U);
  EXPECT_LT(visited / 200, 60U);
}

}  // namespace
}  // namespace hl
