// A scene of placed shapes against the same scene with every vertex placed by hand.
#include "scene/scene_at.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/scenes.h"

namespace hl::test_scene_at {
namespace {

Model randomModel(test::Random& random) {
  Model model;
  for (std::uint32_t i = 0; i < 30; ++i) {
    for (int corner = 0; corner < 3; ++corner) model.positions.push_back(random.inCube(1));
    model.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  model.segments.push_back({0, 4});
  model.points.push_back(7);
  return model;
}

Pose randomPose(test::Random& random) {
  return {Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix(), random.inCube(2)};
}

struct Twins {
  std::shared_ptr<const Snapshot> placed, whole;
};

Twins twins(test::Random& random) {
  std::vector<Instance> instances;
  Model whole;
  for (std::uint64_t key = 1; key <= 3; ++key) {
    const Model part = randomModel(random);
    const Pose pose = randomPose(random);
    const auto base = static_cast<std::uint32_t>(whole.positions.size());
    for (const Vec3& p : part.positions) whole.positions.push_back(pose.toWorld(p));
    for (const auto& t : part.triangles) whole.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    for (const auto& s : part.segments) whole.segments.push_back({base + s[0], base + s[1]});
    for (const std::uint32_t p : part.points) whole.points.push_back(base + p);
    Instance instance;
    instance.shape = makeShape(part, HierarchyKind::kBvh);
    instance.surfaces = surfacesOf(instance.shape);
    instance.motion = Motion(pose);
    instance.key = key;
    instances.push_back(instance);
  }
  return {makeSnapshot(instances), makeSnapshot(whole, HierarchyKind::kNone)};
}

TEST(SceneAt, AnswersAsIfEveryVertexWerePlacedByHand) {
  test::Random random(11);
  for (int i = 0; i < 100; ++i) {
    const Twins scenes = twins(random);
    const SceneAt placed(*scenes.placed), whole(*scenes.whole);
    EXPECT_LT((scenes.placed->bounds.min - scenes.whole->bounds.min).maxCoeff(), 1e-12);  // contains it
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = random.inCube(3), motion = random.inCube(3);
      std::vector<double> a, b;
      placed.primitivesWithin(p, 1, [&](PrimitiveId id, const ClosestPoint& c) {
        a.push_back(c.distance);
        EXPECT_NEAR((p - c.point).norm(), c.distance, 1e-12);
        EXPECT_NEAR((placed.closest(id, p).point - c.point).norm(), 0, 1e-12);
      });
      whole.primitivesWithin(p, 1, [&](PrimitiveId, const ClosestPoint& c) { b.push_back(c.distance); });
      const auto distinct = [](std::vector<double>& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end(), [](double x, double y) { return y - x < 1e-12; }), list.end());
      };
      distinct(a);
      distinct(b);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t n = 0; n < a.size(); ++n) EXPECT_NEAR(a[n], b[n], 1e-12);
      SceneImpact hit_a, hit_b;
      ASSERT_EQ(placed.firstImpact(p, motion, 0.05, 0, hit_a), whole.firstImpact(p, motion, 0.05, 0, hit_b));
      EXPECT_NEAR(hit_a.impact.t, hit_b.impact.t, 1e-10);
      // Of several that it touches from the start each scene names the first in its own order.
      if (hit_a.impact.t > 0) {
        EXPECT_LT((hit_a.impact.normal - hit_b.impact.normal).norm(), 1e-8);
      }
    }
  }
}

TEST(SceneAt, TheOrderInWhichInstancesAreGivenDecidesNothing) {
  test::Random random(12);
  const Twins scenes = twins(random);
  std::vector<Instance> turned(scenes.placed->instances.rbegin(), scenes.placed->instances.rend());
  const auto other = makeSnapshot(turned);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(other->instances[i].key, scenes.placed->instances[i].key);
}

// Copies in one place: the tie is decided the same way from both sides.
TEST(SceneAt, PrecedesIsAnOrder) {
  test::Random random(13);
  const auto shape = makeShape(randomModel(random), HierarchyKind::kNone);
  std::vector<Instance> instances(2);
  for (std::uint64_t i = 0; i < 2; ++i) {
    instances[i].shape = shape;
    instances[i].surfaces = surfacesOf(shape);
    instances[i].key = i + 1;
  }
  const auto snapshot = makeSnapshot(instances);
  const SceneAt scene(*snapshot);
  EXPECT_TRUE(scene.precedes({0, 3}, {1, 3}));
  EXPECT_FALSE(scene.precedes({1, 3}, {0, 3}));
  EXPECT_NE(scene.precedes({0, 3}, {1, 5}), scene.precedes({1, 5}, {0, 3}));
}

TEST(Snapshot, AThousandInstancesOfAShapeCostOneCopy) {
  test::Random random(15);
  Instance instance;
  instance.shape = makeShape(randomModel(random));
  instance.surfaces = surfacesOf(instance.shape);
  const std::size_t one = memoryOf(*makeSnapshot({instance}));
  std::vector<Instance> thousand(1000, instance);
  for (std::size_t i = 0; i < thousand.size(); ++i) thousand[i].key = i;
  const auto snapshot = makeSnapshot(thousand);
  constexpr std::size_t kOfOne = sizeof(Instance) + 200;  // and its box, in the list and in the tree
  EXPECT_GE(one, instance.shape->bytes());
  EXPECT_LE(memoryOf(*snapshot), one + 1000 * kOfOne);
  EXPECT_EQ(snapshot->primitives, 1000 * instance.shape->primitives.size());
}

TEST(Snapshot, AnInstanceIsPlainWhenAllItsMaterialsAreTheDefault) {
  Model model;
  model.positions = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  model.triangles = {{0, 1, 2}};
  const auto plain = [&](const std::vector<Material>& materials) {
    Instance instance;
    instance.shape = makeShape(Model(model));
    auto surfaces = std::make_shared<Surfaces>();
    surfaces->materials = materials;
    instance.surfaces = surfaces;
    return makeSnapshot({instance})->instances[0].plain;
  };
  Material soft, rough, smooth, textured;
  soft.stiffness = 0.5;
  rough.static_friction = 0.1;
  smooth.smooth = true;
  textured.textureOf(Quantity::kHeight).texture = 0;
  EXPECT_TRUE(plain({Material{}}));
  EXPECT_TRUE(plain({Material{}, Material{}}));
  for (const Material& other : {soft, rough, smooth, textured}) EXPECT_FALSE(plain({Material{}, other}));
}

TEST(SceneAt, ReachContainsTheWholeMotion) {
  test::Random random(14);
  for (int i = 0; i < 300; ++i) {
    Instance instance;
    instance.shape = makeShape(randomModel(random), HierarchyKind::kNone);
    instance.surfaces = surfacesOf(instance.shape);
    instance.motion = Motion(randomPose(random)).then(randomPose(random), 0, 100).then(randomPose(random), 60, 200);
    const auto snapshot = makeSnapshot({instance});
    const Box& reach = snapshot->reach[0];
    for (std::int64_t t = 0; t <= 200; t += 5) {
      for (const Primitive& primitive : snapshot->shape().primitives) {
        const Vec3 p = instance.motion.at(t).toWorld(primitive.vertex[0]);
        ASSERT_TRUE((p.array() >= reach.min.array() - 1e-9).all() && (p.array() <= reach.max.array() + 1e-9).all());
      }
    }
  }
}

TEST(SceneAt, WhatWasReadOfOneSnapshotIsNotTakenForAnother) {
  test::Random random(9);
  ManyRecentPrimitives recent;
  for (int round = 0; round < 20; ++round) {
    const auto snapshot = makeSnapshot(randomModel(random));
    for (int tick = 0; tick < 3; ++tick) {
      const SceneAt scene(*snapshot, 0, recent);
      for (std::uint32_t element = 0; element < 32; ++element) {
        const Primitive judged = snapshot->instances[0].shape->primitives[element];
        ASSERT_EQ(scene.primitive({0, element}).vertex, judged.vertex);
        ASSERT_EQ(scene.primitive({0, element}).kind, judged.kind);
      }
    }
  }
}

// What is asked in each step or tick need not look at all instances.
TEST(SceneAt, TheSnapshotListsWhatMoves) {
  test::Random random(3);
  std::vector<Instance> instances;
  for (std::uint64_t key = 1; key <= 5; ++key) {
    Instance instance;
    instance.shape = makeShape(randomModel(random), HierarchyKind::kNone);
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = key;
    if (key % 2 == 0) instance.motion = Motion().then(randomPose(random), 0, 1000);
    instances.push_back(instance);
  }
  EXPECT_EQ(makeSnapshot(instances)->moving, (std::vector<std::uint32_t>{1, 3}));
}

}  // namespace
}  // namespace hl::test_scene_at
