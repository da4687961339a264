// A patch, linear in the place, against the closest point asked anew at every place.
#include "proxy/patch.h"

#include <gtest/gtest.h>

#include "geometry/scenes.h"
#include "scene/snapshot.h"

namespace hl::test_patch {
namespace {

constexpr PrimitiveId kTriangle{0, 0};
const MaterialOverride kNothingSet;

// One triangle somewhere, with leaning normals and a bump map, and a friction that follows an image.
std::shared_ptr<const Snapshot> randomTriangle(test::Random& random) {
  Model model;
  for (int corner = 0; corner < 3; ++corner) {
    model.positions.push_back(random.inCube(1));
    model.texcoords.emplace_back(random.uniform(-1, 2), random.uniform(-1, 2));
  }
  const Vec3 up = (model.positions[1] - model.positions[0]).cross(model.positions[2] - model.positions[0]).normalized();
  for (int corner = 0; corner < 3; ++corner) model.normals.push_back((up + 0.4 * random.inCube(1)).normalized());
  model.triangles.push_back({0, 1, 2});
  model.textures = {makeTexture("sine", 16), makeTexture("noise", 8)};
  model.materials.resize(1);
  model.materials[0].smooth = true;
  model.materials[0].textureOf(Quantity::kHeight) = {0, 0, 0.01};
  model.materials[0].textureOf(Quantity::kDynamicFriction) = {1, 0.1, 0.9};
  Instance instance;
  instance.shape = makeShape(std::move(model));
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion({Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix(), {1, 2, 3}});
  instance.key = 1;
  return makeSnapshot({instance});
}

Patch patchAt(const SceneAt& scene, const Surface& surface, const ClosestPoint& nearest) {
  return {scene, surface, {kTriangle, nearest.normal, nearest.weights}};
}

TEST(Patch, SaysWhatAnotherSearchSays) {
  test::Random random(3);
  int covered = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto snapshot = randomTriangle(random);
    if (snapshot->primitives == 0) continue;
    const SceneAt scene(*snapshot);
    const Surface surface(scene, kNothingSet, kTriangle);
    const Vec3 from = Vec3(1, 2, 3) + random.inCube(1), step = 0.3 * random.inCube(1);
    const ClosestPoint before = scene.closest(kTriangle, from), after = scene.closest(kTriangle, from + step);
    const Patch patch = patchAt(scene, surface, before);
    const Vec2 moved = patch.weightsOver(step);
    const bool same_face = before.feature == Feature::kFace && after.feature == Feature::kFace;
    const bool same_side = before.normal.dot(after.normal) > 0;
    EXPECT_TRUE(patch.covers(moved) || !same_face) << i;
    if (!patch.covers(moved) || !same_side) continue;
    ++covered;
    const Patch anew = patchAt(scene, surface, after);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(patch.place(moved).weights[k], after.weights[k], 1e-9) << i;
    EXPECT_LT((patch.shadingNormal(moved).normal - anew.shadingNormal().normal).norm(), 1e-6)
        << i;  // 1e4 of the bump map's slope a metre
    EXPECT_NEAR(patch.shadingNormal(moved).shading, anew.shadingNormal().shading, 1e-8) << i;
    EXPECT_LT((patch.texcoord(moved) - anew.texcoord(Vec2::Zero())).norm(), 1e-8) << i;
  }
  EXPECT_GT(covered, 500);
}

TEST(Patch, OnAnEdgeCoversNothing) {
  test::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const auto snapshot = randomTriangle(random);
    if (snapshot->primitives == 0) continue;
    const SceneAt scene(*snapshot);
    const ClosestPoint nearest = scene.closest(kTriangle, Vec3(1, 2, 3) + random.inCube(2));
    if (nearest.feature == Feature::kFace) continue;
    EXPECT_FALSE(patchAt(scene, Surface(scene, kNothingSet, kTriangle), nearest).covers(Vec2::Zero())) << i;
  }
}

TEST(Patch, WithoutUsableNormalsFeelsAsItIs) {
  test::Random random(5);
  const auto snapshot = randomTriangle(random);
  const SceneAt scene(*snapshot);
  MaterialOverride plain;
  plain.textures = false;
  const Primitive& triangle = scene.primitive(kTriangle);
  const SurfacePoint behind{kTriangle, -scene.turnToWorld(kTriangle, triangle.normal), {0.3, 0.3, 0.4}};
  const Patch patch(scene, Surface(scene, plain, kTriangle), behind);
  EXPECT_FALSE(patch.shadingNormal().differs());
  EXPECT_EQ(patch.shadingNormal().normal, behind.normal);
}

}  // namespace
}  // namespace hl::test_patch
