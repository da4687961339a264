// Primitives put together from a mesh against those made one by one.
#include "geometry/primitives.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <limits>

#include "geometry/scenes.h"

namespace hl::test_primitives {
namespace {

using test::Mesh;

// Some vertices coincide, one is not a number and one out of reach; some indices are out of range.
Mesh randomMesh(test::Random& random, int of_each_kind) {
  Mesh mesh;
  constexpr int kVertices = 30;
  for (int i = 0; i < kVertices; ++i) mesh.positions.push_back(random.inCube(1));
  mesh.positions[3] = mesh.positions[4];
  mesh.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
  mesh.positions[6].z() = 2 * kFarthest_m;
  const auto index = [&] { return static_cast<std::uint32_t>(random.below(kVertices + 1)); };
  for (int i = 0; i < of_each_kind; ++i) {
    mesh.triangles.push_back({index(), index(), index()});
    mesh.segments.push_back({index(), index()});
    mesh.points.push_back(index());
  }
  return mesh;
}

std::vector<Primitive> oneByOne(const Mesh& mesh) {
  std::vector<Primitive> made;
  const auto& p = mesh.positions;
  Primitive out;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    if (std::max({t[0], t[1], t[2]}) < p.size() && makeTriangle(p[t[0]], p[t[1]], p[t[2]], i, out)) made.push_back(out);
  }
  for (std::uint32_t i = 0; i < mesh.segments.size(); ++i) {
    const auto& s = mesh.segments[i];
    if (std::max(s[0], s[1]) < p.size() && test::makeSegment(p[s[0]], p[s[1]], i, out)) made.push_back(out);
  }
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    if (mesh.points[i] < p.size() && test::makePoint(p[mesh.points[i]], i, out)) made.push_back(out);
  }
  return made;
}

void expectSame(const Primitive& a, const Primitive& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.vertex, b.vertex);
  EXPECT_EQ(a.normal, b.normal);
}

void expectThoseMadeOneByOne(const Mesh& mesh) {
  const Primitives primitives(mesh.view());
  const std::vector<Primitive> expected = oneByOne(mesh);
  ASSERT_EQ(primitives.size(), expected.size());
  EXPECT_EQ(primitives.size() + primitives.refused().sum(), mesh.view().elements());
  EXPECT_GT(primitives.refused().triangles, 0u);
  Box bounds;
  std::size_t i = 0;
  for (const Primitive& primitive : primitives) {
    expectSame(primitive, expected[i]);
    EXPECT_EQ(primitives.kind(i), expected[i].kind);
    EXPECT_EQ(primitives.source(i), expected[i].source);
    for (const Vec3& corner : primitives.corners(i)) {
      EXPECT_NE(std::count(expected[i].vertex.begin(), expected[i].vertex.end(), corner), 0);
      bounds.extend(corner);
    }
    ++i;
  }
  for (const Box& box : {primitives.bounds(), Primitives(expected).bounds()}) {
    EXPECT_EQ(box.min, bounds.min);
    EXPECT_EQ(box.max, bounds.max);
  }
}

TEST(Primitives, AreThoseMadeOneByOne) {
  test::Random random(3);
  for (int round = 0; round < 20; ++round) expectThoseMadeOneByOne(randomMesh(random, 100));
}

TEST(Primitives, SoManyThatThreadsShareThemAreThoseMadeOneByOne) {
  test::Random random(5);
  const Mesh mesh = randomMesh(random, 10'000);
  for (const std::size_t threads : {1, 2, 4}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    expectThoseMadeOneByOne(mesh);
  }
}

TEST(Primitives, OfNothingHaveAnEmptyBox) {
  EXPECT_TRUE(Primitives().bounds().empty());
  Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  mesh.triangles = {{0, 0, 0}};
  EXPECT_TRUE(mesh.primitives().bounds().empty());
}

TEST(Primitives, OfASoundMeshNeedNoMemoryOfTheirOwn) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.points = {1};
  const Primitives primitives(mesh.view());
  EXPECT_EQ(primitives.bytes(), 0u);
  EXPECT_EQ(primitives.size(), 2u);
  EXPECT_EQ(primitives[0].normal, Vec3::UnitZ());
  EXPECT_EQ(primitives[1].vertex[0], Vec3::UnitX());
}

TEST(Primitives, ReadyOnesAreThemselves) {
  test::Random random(4);
  const std::vector<Primitive> soup = test::soup(random, 50, 1, 0.3);
  const Primitives primitives(soup);
  ASSERT_EQ(primitives.size(), soup.size());
  for (std::size_t i = 0; i < soup.size(); ++i) expectSame(primitives[i], soup[i]);
}

}  // namespace
}  // namespace hl::test_primitives
