// A scene for threads that do not tick: its bodies stand where they are shown, and nothing of the loop's is read.
#include "scene/still_scene.h"

#include <gtest/gtest.h>

#include "scene/rigid_body.h"
#include "scene/scene_at.h"

namespace hl::test_still_scene {
namespace {

constexpr std::int64_t kMs = 1'000'000;

Instance triangleAt(std::uint64_t key, double y) {
  Model model;
  model.positions = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
  model.triangles = {{0, 1, 2}};
  Instance instance;
  instance.key = key;
  instance.shape = makeShape(std::move(model), HierarchyKind::kBvh);
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion(Pose{Mat3::Identity(), {0, y, 0}});
  return instance;
}

// How far a sphere falls from (0, 1, 0) by 2 m.
double fall(const Snapshot& scene) {
  SceneImpact impact;
  return SceneAt(scene).firstImpact({0, 1, 0}, {0, -2, 0}, 0.1, -1, impact) ? 2 * impact.impact.t : 2;
}

TEST(StillScene, BodiesStandWhereTheLoopHasShownThem) {
  Instance body = triangleAt(2, 0);
  const Box room{Vec3::Constant(-10), Vec3::Constant(10)};
  setBody(body, makeRigidBody("it", BodySpec{}, Pose{Mat3::Identity(), {0, 0.5, 0}}, body.shape->bounds, room));
  BodyPoses& poses = *body.body->poses;
  const auto scene = makeSnapshot({triangleAt(1, 0), body});
  StillScene still;
  EXPECT_NEAR(fall(still.of(scene)), 0.4, 1e-12);
  for (int step = 1; step <= 5; ++step) {
    poses.moveTo(ShownBody{Pose{Mat3::Identity(), {0, 0.5 - 0.1 * step, 0}}}, (step - 1) * kMs, step * kMs);
    EXPECT_NEAR(fall(still.of(scene)), 0.4 + 0.1 * step, 1e-12);
  }
  poses.jumpTo(Pose{Mat3::Identity(), {5, 0.5, 0}});
  EXPECT_NEAR(fall(still.of(scene)), 0.9, 1e-12) << "it has left the way to what is fixed";
  EXPECT_NE(still.of(scene).instances[1].body->poses.get(), &poses);
}

TEST(StillScene, WithoutBodiesItIsTheSceneItself) {
  const auto scene = makeSnapshot({triangleAt(1, 0)}), other = makeSnapshot({triangleAt(1, 0.5)});
  StillScene still;
  EXPECT_EQ(&still.of(scene), scene.get());
  EXPECT_EQ(&still.of(other), other.get());
}

}  // namespace
}  // namespace hl::test_still_scene
