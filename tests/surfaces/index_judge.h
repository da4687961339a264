// The queries of an index against those of the hierarchy over the same triangles as a mesh: the same answers bit for
// bit. `draw(random)` gives a surface that makes its triangles, `drawBall(random, surface)` a ball on or around it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "environment.h"
#include "geometry/primitive_source.h"
#include "geometry/queries.h"
#include "geometry/scenes.h"
#include "geometry/wide_bvh.h"

namespace hl::test {

/// All primitives of a surface as a mesh.
inline Mesh meshOf(const PrimitiveSource& source) {
  Mesh mesh;
  if (source.kind() == PrimitiveKind::kPoint) {
    source.makeIndex()->overlap(Vec3::Zero(), INFINITY,
                                [&](ElementId id) { mesh.points.push_back(mesh.add(source.corners(id)[0])); });
    return mesh;
  }
  const DrawnMesh drawn = source.drawn(~std::size_t{0});
  return {drawn.positions, drawn.triangles, {}, {}};
}

/// A surface that makes its triangles, and the judge: the hierarchy over the same triangles as a mesh.
struct SourceAndMesh {
  explicit SourceAndMesh(std::shared_ptr<const PrimitiveSource> given)
      : source(std::move(given)),
        own(source->makeIndex()),
        index(*own),
        mesh(meshOf(*source)),
        primitives(mesh.view()),
        bvh(WideBvh::build(primitives)) {}

  bool impact(const Vec3& from, const Vec3& motion, double radius, double touching, bool of_mesh, FirstImpact& out,
              Primitive& hit) const {
    Primitive last;
    const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*source, id); };
    const bool found = of_mesh ? hl::firstImpact(bvh, primitives, from, motion, radius, touching, out)
                               : hl::firstImpact(index, read, from, motion, radius, touching, out);
    if (found) hit = of_mesh ? primitives[out.primitive] : primitiveOf(*source, out.primitive);
    return found;
  }

  std::shared_ptr<const PrimitiveSource> source;
  std::unique_ptr<const SpatialIndex> own;
  const SpatialIndex& index;
  Mesh mesh;
  Primitives primitives;
  WideBvh bvh;
};

using Distances = std::vector<std::array<double, 10>>;  // a distance, and the vertices it is to

inline Distances sorted(Distances list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

inline std::array<double, 10> entryOf(const Primitive& primitive, double distance) {
  std::array<double, 10> entry{distance};
  for (std::size_t i = 0; i < 9; ++i) entry[i + 1] = primitive.vertex[i / 3][static_cast<Eigen::Index>(i % 3)];
  return entry;
}

/// HL_LONGER=10 in the environment: so many times as many surfaces.
inline int longer() { return numberIn("HL_LONGER", 1); }

/// A place on the surface or around it, and a radius: of a part of a cell, or of many.
struct TestBall {
  Vec3 centre;
  double radius, cell;
};

/// A hit in so many queries, at least.
template <typename Draw, typename DrawBall>
void expectImpactsOfMesh(const Draw& draw, const DrawBall& drawBall, int queries_per_hit, int scenes = 400,
                         int balls = 300) {
  scenes *= longer();
  Random random(1);
  int hits = 0, queries = 0;
  for (int scene = 0; scene < scenes; ++scene) {
    const auto source = draw(random);
    const SourceAndMesh pair(source);
    for (int i = 0; i < balls; ++i, ++queries) {
      const TestBall ball = drawBall(random, *source);
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
  EXPECT_GT(hits, queries / queries_per_hit);
}

/// A search that is to stop after so many visits those that the whole search visits first.
inline void expectStop(const SpatialIndex& index, const TestBall& ball, std::size_t most) {
  std::vector<ElementId> all, few;
  const std::size_t whole_cost = index.overlap(ball.centre, ball.radius, [&](ElementId id) { all.push_back(id); });
  const std::size_t cost = index.overlapUntil(ball.centre, ball.radius, [&](ElementId id) {
    few.push_back(id);
    return few.size() >= most;
  });
  ASSERT_LE(cost, whole_cost);
  all.resize(std::min(all.size(), most));
  ASSERT_EQ(few, all);
}

template <typename Draw, typename DrawBall>
void expectDistancesOfMesh(const Draw& draw, const DrawBall& drawBall, int scenes = 400, int balls = 150) {
  scenes *= longer();
  Random random(2);
  std::size_t found = 0;
  for (int scene = 0; scene < scenes; ++scene) {
    const auto source = draw(random);
    const SourceAndMesh pair(source);
    for (int i = 0; i < balls; ++i) {
      const TestBall ball = drawBall(random, *source);
      Distances a, b;
      Primitive last;
      const auto read = [&](ElementId id) -> const Primitive& { return last = primitiveOf(*source, id); };
      primitivesWithin(pair.index, read, ball.centre, ball.radius, [&](ElementId id, const ClosestPoint& nearest) {
        a.push_back(entryOf(primitiveOf(*source, id), nearest.distance));
      });
      primitivesWithin(pair.bvh, pair.primitives, ball.centre, ball.radius,
                       [&](ElementId id, const ClosestPoint& nearest) {
                         b.push_back(entryOf(pair.primitives[id], nearest.distance));
                       });
      a = sorted(std::move(a));
      ASSERT_EQ(a, sorted(std::move(b))) << "scene " << scene << " query " << i;
      found += a.size();
      expectStop(pair.index, ball, 1 + static_cast<std::size_t>(i) % 7);
    }
  }
  EXPECT_GT(found, static_cast<std::size_t>(scenes * balls));
}

template <typename Draw, typename DrawBall>
void expectNearestOfMesh(const Draw& draw, const DrawBall& drawBall, int scenes = 300, int balls = 100) {
  scenes *= longer();
  Random random(3);
  for (int scene = 0; scene < scenes; ++scene) {
    const auto source = draw(random);
    const SourceAndMesh pair(source);
    for (int i = 0; i < balls; ++i) {
      TestBall ball = drawBall(random, *source);
      ball.centre += std::pow(10.0, random.uniform(-3, 2)) * ball.cell * random.direction();
      const double farthest = random.below(2) == 0 ? INFINITY : 3 * ball.radius;
      double a = INFINITY, b = INFINITY;
      pair.index.nearest(ball.centre, farthest, [&](ElementId id, double limit) {
        a = std::min(a, closestPoint(primitiveOf(*source, id), ball.centre).distance);
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

}  // namespace hl::test
