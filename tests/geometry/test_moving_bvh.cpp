// A mesh between two places, asked by two hierarchies walked as one: it must propose all that brute force finds.
#include "geometry/moving_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geometry/closest_point.h"
#include "geometry/queries.h"
#include "geometry/scenes.h"

namespace hl::test_moving_bvh {
namespace {

using test::Random;

test::Mesh soup(Random& random, int triangles) {
  test::Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 at = random.inCube(1);
    const auto first = mesh.add(at);
    mesh.add(at + random.inCube(0.1));
    mesh.add(at + random.inCube(0.1));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// A sheet on a slope, so that nodes have frames of their own.
test::Mesh slope(Random& random, int cells) {
  test::Mesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      const double x = 2.0 * i / cells - 1, z = 2.0 * k / cells - 1;
      mesh.add(Vec3(x, 0.7 * x + 0.4 * z + 0.01 * random.uniform(-1, 1), z));
    }
  }
  const auto at = [cells](int i, int k) { return static_cast<std::uint32_t>(i * (cells + 1) + k); };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      mesh.triangles.push_back({at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
    }
  }
  return mesh;
}

class Moving {
 public:
  Moving(Random& random, int kind)
      : from_(kind == 0 ? soup(random, 1 + random.below(300)) : slope(random, 3 + random.below(20))), to_(from_) {
    const Vec3 far = random.below(2) * 5 * random.direction();
    const double size = random.uniform(0, 0.5);
    for (Vec3& p : to_.positions) p += far + random.inCube(size);
    from_primitives_ = from_.primitives();
    to_primitives_ = to_.primitives();
    from_tree_ = WideBvh::build(from_primitives_);
    to_tree_ = from_tree_.refit(to_primitives_);
  }
  Primitive at(std::size_t i, double part) const {
    std::array<Vec3, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = from_.triangles[i][k];
      v[k] = (1 - part) * from_.positions[vertex] + part * to_.positions[vertex];
    }
    return shrunkenOf(PrimitiveKind::kTriangle, v, static_cast<std::uint32_t>(i));
  }
  std::size_t size() const { return from_.triangles.size(); }
  const WideBvh& from() const { return from_tree_; }
  const WideBvh& to() const { return to_tree_; }

 private:
  test::Mesh from_, to_;
  Primitives from_primitives_, to_primitives_;
  WideBvh from_tree_, to_tree_;
};

TEST(MovingBvh, FindsAllThatComesNearWithinItsTime) {
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const Moving moving(random, i % 2);
    ASSERT_TRUE(moving.to().isTreeOf(moving.from()));
    const double begin = random.uniform(0, 1), end = i % 4 < 2 ? begin : random.uniform(begin, 1);
    const Vec3 centre = random.inCube(1.5);
    const double radius = random.uniform(0, 0.4);
    std::set<std::uint32_t> found;
    MovingBvh(moving.from(), moving.to(), begin, end).overlap(centre, radius, [&](ElementId primitive) {
      found.insert(primitive);
    });
    for (std::uint32_t k = 0; k < moving.size(); ++k) {
      for (int step = 0; step <= 8; ++step) {
        const double part = begin + step / 8.0 * (end - begin);
        const bool near = closestPoint(moving.at(k, part), centre).distance <= radius;
        ASSERT_TRUE(!near || found.count(k) > 0) << "mesh " << i << ", primitive " << k << " at " << part;
      }
    }
  }
}

TEST(MovingBvh, TheFirstImpactIsThatOfEveryPrimitive) {
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Moving moving(random, i % 2);
    const double part = random.uniform(0, 1), radius = random.uniform(0.001, 0.3);
    const Vec3 from = random.inCube(2), motion = random.uniform(0.01, 4) * random.direction();
    const MovingBvh index(moving.from(), moving.to(), part);
    Primitive last;
    const auto read = [&](std::uint32_t k) -> const Primitive& { return last = moving.at(k, part); };
    FirstImpact found;
    const bool hit = firstImpact(index, read, from, motion, radius, -1, found);
    double first = 2;
    for (std::uint32_t k = 0; k < moving.size(); ++k) {
      Impact impact;
      if (sweepSphere(moving.at(k, part), from, motion, radius, impact)) first = std::min(first, impact.t);
    }
    ASSERT_EQ(hit, first <= 1) << i;
    ASSERT_TRUE(!hit || found.impact.t == first) << i;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace hl::test_moving_bvh
