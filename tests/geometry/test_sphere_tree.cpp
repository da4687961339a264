// C53, C54, C55: what the paper's section 6.2 promises of its tree, and that it never changes an answer.
#include "geometry/sphere_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/brute_force.h"
#include "geometry/queries.h"
#include "geometry/scenes.h"

namespace hl::test_sphere_tree {
namespace {

using Sphere = SphereTree::Sphere;

std::size_t leafOf(std::int32_t link) {
  const std::int32_t leaf = ~link;
  return static_cast<std::size_t>(leaf);
}

Vec3 centreOf(const Sphere& sphere) { return {sphere.centre[0], sphere.centre[1], sphere.centre[2]}; }

// Smallest of both heuristics of a node, recomputed from its two child spheres and its leaves [begin, end).
double smallestRadius(const SphereTree& tree, const Sphere& a, const Sphere& b, std::size_t begin, std::size_t end) {
  const double distance = (centreOf(a) - centreOf(b)).norm();
  const double ra = a.radius, rb = b.radius;
  const double pair = distance + rb <= ra ? ra : distance + ra <= rb ? rb : 0.5 * (distance + ra + rb);
  Vec3 low = centreOf(tree.leaves()[begin].sphere), high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(centreOf(tree.leaves()[i].sphere));
    high = high.cwiseMax(centreOf(tree.leaves()[i].sphere));
  }
  double box = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const Sphere& leaf = tree.leaves()[i].sphere;
    box = std::max(box, (centreOf(leaf) - 0.5 * (low + high)).norm() + leaf.radius);
  }
  return std::min(pair, box);
}

// Walks the tree, checks every node against the leaves below it, and returns how many leaves that are.
std::size_t checkNode(const SphereTree& tree, std::int32_t link, std::size_t begin) {
  if (link < 0) {
    EXPECT_EQ(leafOf(link), begin) << "leaves are in depth-first order";
    return 1;
  }
  const SphereTree::Node& node = tree.nodes()[static_cast<std::size_t>(link)];
  std::size_t count = 0;
  for (const std::int32_t child : node.child) count += checkNode(tree, child, begin + count);
  for (std::size_t i = begin; i < begin + count; ++i) {
    const Sphere& leaf = tree.leaves()[i].sphere;
    const double reach = (centreOf(leaf) - centreOf(node.sphere)).norm() + leaf.radius;
    EXPECT_LE(reach, node.sphere.radius * (1 + 1e-14)) << "a leaf sticks out of an ancestor";
  }
  const auto sphere_of = [&](std::int32_t child) {
    return child < 0 ? tree.leaves()[leafOf(child)].sphere : tree.nodes()[static_cast<std::size_t>(child)].sphere;
  };
  const double best = smallestRadius(tree, sphere_of(node.child[0]), sphere_of(node.child[1]), begin, begin + count);
  constexpr double kOutward = 1e-6;    // rounding to single precision, relative to radius and coordinates
  constexpr double kSmallest = 1e-44;  // a few of the smallest floats
  EXPECT_LE(node.sphere.radius, best * (1 + 4 * kOutward) + kOutward * centreOf(node.sphere).norm() + kSmallest);
  return count;
}

void checkTree(const SphereTree& tree) {
  if (tree.nodes().empty()) return;
  EXPECT_EQ(checkNode(tree, 0, 0), tree.leaves().size());
  EXPECT_EQ(tree.nodes().size() + 1, tree.leaves().size());
}

// Random points of random primitives of the scene, each of which must lie in a leaf sphere of that very primitive.
void checkCover(const std::vector<Primitive>& scene, test::Random& random, int samples) {
  const SphereTree tree = SphereTree::build(scene);
  std::vector<std::vector<Sphere>> leaves(scene.size());
  for (const SphereTree::Leaf& leaf : tree.leaves()) leaves[leaf.primitive].push_back(leaf.sphere);
  for (const auto& of_primitive : leaves) ASSERT_LE(of_primitive.size(), 64u);
  for (int i = 0; i < samples; ++i) {
    const auto number = static_cast<std::size_t>(random.below(static_cast<int>(scene.size())));
    const Primitive& primitive = scene[number];
    const double a = random.uniform(0, 1), b = random.uniform(0, 1 - a);
    const Vec3 p = primitive.vertex[0] + a * (primitive.vertex[1] - primitive.vertex[0]) +
                   b * (primitive.vertex[2] - primitive.vertex[0]);
    const bool covered = std::any_of(leaves[number].begin(), leaves[number].end(), [&](const Sphere& sphere) {
      return (p - centreOf(sphere)).norm() <= sphere.radius;
    });
    ASSERT_TRUE(covered) << "point " << p.transpose() << " of primitive " << number;
  }
}

TEST(SphereTree, C53EveryPointOfEveryPrimitiveIsInALeafSphere) {
  test::Random random(31);
  checkCover(test::soup(random, 2000, 1, 0.2), random, 400'000);
  checkCover(test::soup(random, 2000, 1e-4, 1e-5), random, 200'000);
  checkCover(test::soup(random, 2000, 1e5, 1e3), random, 200'000);
  checkCover(test::terrain(30), random, 200'000);
}

TEST(SphereTree, C53EveryLeafIsInEachAncestorAndTheSmallerHeuristicWins) {
  test::Random random(32);
  checkTree(SphereTree::build(test::soup(random, 3000, 1, 0.1)));
  checkTree(SphereTree::build(test::soup(random, 3000, 1e4, 1)));
  checkTree(SphereTree::build(test::terrain(50)));
}

// Of all nodes of a tree, the leaves below them: returns those below this one, and adds to the sum.
std::size_t sumOfLeaves(const SphereTree& tree, std::int32_t link, std::size_t& sum) {
  if (link < 0) return 1;
  std::size_t below = 0;
  for (const std::int32_t child : tree.nodes()[static_cast<std::size_t>(link)].child)
    below += sumOfLeaves(tree, child, sum);
  sum += below;
  return below;
}

double lgLeaves(const SphereTree& tree) { return std::log2(static_cast<double>(tree.leaves().size())); }

TEST(SphereTree, C54DepthAndWorkOfTheBuildGrowLikeTheLogarithm) {
  test::Random random(33);
  for (const int cells : {22, 71, 224}) {
    const SphereTree sheet = SphereTree::build(test::terrain(cells));
    const SphereTree loose = SphereTree::build(test::soup(random, test::terrain(cells).size(), 1, 0.02));
    for (const SphereTree* tree : {&sheet, &loose}) {
      const double n = static_cast<double>(tree->leaves().size());
      EXPECT_LE(tree->stats().depth, 2.5 * lgLeaves(*tree));
      // The build looks twice at every leaf below a node; a leaf is below about 1.2 lg n nodes.
      std::size_t leaves_below = 0;
      sumOfLeaves(*tree, 0, leaves_below);
      EXPECT_LE(static_cast<double>(2 * leaves_below), 3 * n * lgLeaves(*tree));
    }
  }
}

TEST(SphereTree, C54ClusteredAndCoincidentInputsKeepTheDepthBounded) {
  std::vector<Primitive> halving, same, nested;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Primitive point;
    // Each middle split would take off one point only.
    ASSERT_TRUE(test::makePoint(Vec3(std::pow(0.9, i), 0, 0), i, point));
    halving.push_back(point);
    ASSERT_TRUE(test::makePoint(Vec3(1, 2, 3), i, point));
    same.push_back(point);
    const double size = std::pow(0.95, i);
    test::addTriangle(nested, Vec3(0, 0, 0), Vec3(size, 0, 0), Vec3(0, size, 0));
  }
  for (const auto* scene : {&halving, &same, &nested}) {
    const SphereTree tree = SphereTree::build(*scene);
    EXPECT_LE(tree.stats().depth, 2.5 * lgLeaves(tree));
    checkTree(tree);
    std::size_t visits = 0;
    tree.overlap(Vec3(1, 2, 3), 10, [&](std::uint32_t) { ++visits; });
    EXPECT_EQ(visits, tree.leaves().size());
  }
}

// Mean number of leaf spheres proposed by queries of a sphere that slides over the sheet.
double candidates(int cells) {
  const std::vector<Primitive> scene = test::terrain(cells);
  const SphereTree tree = SphereTree::build(scene);
  const double edge = 1.0 / cells;
  test::Random random(34);
  std::size_t proposed = 0;
  constexpr int kQueries = 2000;
  for (int i = 0; i < kQueries; ++i) {
    const Primitive& primitive = scene[static_cast<std::size_t>(random.below(static_cast<int>(scene.size())))];
    const Vec3 from = primitive.vertex[1] + 1.01 * edge * primitive.normal;
    const Vec3 motion = 0.5 * edge * random.direction();
    tree.sweep(from, motion, edge, edge, [&](std::uint32_t, double limit) {
      ++proposed;
      return limit;
    });
  }
  return static_cast<double>(proposed) / kQueries;
}

TEST(SphereTree, C55CandidatesOfAQueryDoNotGrowWithTheSceneWhenTheRadiusScalesWithTheEdges) {
  const double small = candidates(32);
  const double large = candidates(256);  // 64 times as many triangles
  RecordProperty("candidates_2k", std::to_string(small));
  RecordProperty("candidates_131k", std::to_string(large));
  // Slope of log(candidates) over log(n) below 0.15.
  EXPECT_LE(std::log(large / small) / std::log(64.0), 0.15) << small << " -> " << large;
}

TEST(SphereTree, EmptyAndSingleScenesWork) {
  const SphereTree empty = SphereTree::build({});
  std::size_t visits = 0;
  empty.overlap(Vec3::Zero(), 1e9, [&](std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 0u);
  FirstImpact impact;
  EXPECT_FALSE(firstImpact(empty, {}, Vec3::Zero(), Vec3::UnitX(), 1, 0, impact));
  std::vector<Primitive> one(1);
  ASSERT_TRUE(test::makePoint(Vec3(2, 0, 0), 0, one[0]));
  const SphereTree single = SphereTree::build(one);
  EXPECT_TRUE(single.nodes().empty());
  ASSERT_TRUE(firstImpact(single, one, Vec3::Zero(), Vec3(4, 0, 0), 1, 0, impact));
  EXPECT_EQ(impact.impact.t, 0.25);
}

}  // namespace
}  // namespace hl::test_sphere_tree
