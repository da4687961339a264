// What is told of the bodies while a session runs.
#include "touch/bodies_view.h"

#include <gtest/gtest.h>

#include "bodies/test_worlds.h"
#include "scene/scene_model.h"

namespace hl {
namespace {

SceneBody cubeAt(const Vec3& at, double speed_m_s) {
  SceneBody body;
  body.model = test::boxModel(Vec3::Constant(0.01));
  body.pose.origin = at;
  body.spec.mass_kg = 0.2;
  body.spec.shape = BodyShape::kBox;
  body.spec.velocity_m_s.x() = speed_m_s;
  return body;
}

TEST(BodiesView, TellsHowManyMoveAndTheirEnergies) {
  SceneModel scene;
  scene.bodies = {cubeAt(Vec3::Zero(), 0.5), cubeAt(Vec3(0, 0.1, 0), 0)};
  scene.mechanics.gravity_m_s2.setZero();
  const std::unique_ptr<BodyWorld> world = BodyWorld::of(*makeSnapshot(std::move(scene)));
  BodiesView view;
  for (std::int64_t step = 0; step <= 100; ++step) {
    world->step(1'000'000 * step, 1e-3, {});
    view.follow(world.get());
  }
  EXPECT_EQ(view.bodies, 2U);
  EXPECT_EQ(view.moving, 1U);
  EXPECT_NEAR(view.kinetic_J, 0.2 * 0.5 * 0.5 / 2, 1e-12);
  EXPECT_EQ(view.gravity_J, 0);
  EXPECT_EQ(view.dropped + view.unconverged + view.returned, 0U);
  for (std::int64_t step = 101; step <= 1000; ++step) {
    world->step(1'000'000 * step, 1e-3, {});
    view.follow(world.get());
  }
  EXPECT_EQ(view.returned, 1U) << "it has left its room";
  EXPECT_EQ(view.moving, 0U);
  view.follow(nullptr);
  EXPECT_EQ(view.bodies + view.moving, 0U);
  EXPECT_EQ(view.returned, 1U);
}

}  // namespace
}  // namespace hl
