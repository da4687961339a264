// Scene world: what a snapshot says of bodies and joints is what is stepped.
#include "bodies/scene_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies/body_step.h"
#include "bodies/mesh_drawings.h"
#include "bodies/test_worlds.h"

namespace hl::test_scene_world {
namespace {

constexpr double kStep_s = 1e-3, kFall_m = 0.01;

Instance boxInstance(std::uint64_t key, bool fixed, const Vec3& at) {
  BodySpec spec;
  spec.fixed = fixed;
  spec.shape = BodyShape::kBox;
  Instance instance = test::instanceOf(test::boxModel(Vec3::Constant(0.01)), key);
  instance.body = makeRigidBody("box", spec, {Mat3::Identity(), at}, instance.shape->bounds,
                                {Vec3::Constant(-1), Vec3::Constant(1)});
  instance.driver = instance.body->poses;
  instance.motion = Motion(instance.body->start);
  return instance;
}

Instance partsInstance(std::uint64_t key, Model model) {
  BodySpec spec;
  spec.shape = BodyShape::kParts;
  Instance instance = test::instanceOf(std::move(model), key);
  instance.body = makeRigidBody("ring", spec, {}, instance.shape->bounds, {Vec3::Constant(-1), Vec3::Constant(1)});
  instance.driver = instance.body->poses;
  instance.motion = Motion(instance.body->start);
  return instance;
}

// How far a box goes down that hangs on this joint beside a fixed one, m.
double fallOn(const JointSpec& joint) {
  const Vec3 at(0.1, 0, 0);
  const auto snapshot = makeSnapshot({boxInstance(1, false, at), boxInstance(2, true, Vec3::Zero())}, {}, 1, 0,
                                     {Vec3(0, -9.81, 0), {joint}});
  const auto world = worldOf(*snapshot);
  WorldState state = startWorld(*world, {{Mat3::Identity(), at}});
  BodyStepper stepper(world);
  for (int i = 0; i < 500; ++i) stepper.step(state, kStep_s, {}, {});
  return at.y() - state.bodies[0].centre.y();
}

JointSpec slider(std::uint64_t a, std::uint64_t b, double low, double high) {
  JointSpec joint;
  joint.kind = JointKind::kSlider;
  joint.body_a = a;
  joint.body_b = b;
  joint.axis_W = Vec3::UnitY();
  joint.along.low = low;
  joint.along.high = high;
  return joint;
}

TEST(SceneWorld, ASliderHasItsLimitsWhicheverBodyIsFixed) {
  EXPECT_NEAR(fallOn(slider(1, 2, -kFall_m, 0)), kFall_m, 1e-6);
  EXPECT_NEAR(fallOn(slider(2, 1, 0, kFall_m)), kFall_m, 1e-6);
}

TEST(SceneWorld, ARodHoldsWhicheverBodyIsFixed) {
  JointSpec rod;
  rod.kind = JointKind::kDistance;
  rod.body_a = 1;
  rod.body_b = 2;
  rod.anchor_W = Vec3(0.1, 0, 0);
  rod.anchor_b_W = Vec3(0.1, 0.2, 0);
  EXPECT_NEAR(fallOn(rod), 0, 1e-6);
  std::swap(rod.body_a, rod.body_b);
  std::swap(rod.anchor_W, rod.anchor_b_W);
  EXPECT_NEAR(fallOn(rod), 0, 1e-6);
}

TEST(SceneWorld, AJointOfTwoFixedBodiesIsNone) {
  const auto snapshot = makeSnapshot({boxInstance(1, false, Vec3(0.1, 0, 0)), boxInstance(2, true, Vec3::Zero())}, {},
                                     1, 0, {Vec3::Zero(), {slider(2, 0, 0, 1)}});
  EXPECT_TRUE(worldOf(*snapshot)->joints.empty());
}

TEST(SceneWorld, ASceneWithoutBodiesHasNoWorld) {
  EXPECT_EQ(worldOf(*makeSnapshot({boxInstance(2, true, Vec3::Zero())})), nullptr);
}

// 65 boxes on a circle are more than there may be parts, and too far from each other for common ones.
TEST(SceneWorld, PartsThatAreFarFromTheMeshAreReportedOnceForAShape) {
  for (const int count : {8, 65}) {
    std::vector<std::pair<Vec3, Vec3>> boxes;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * EIGEN_PI * i / count;
      boxes.emplace_back(Vec3::Constant(0.1), 10 * Vec3(std::cos(angle), 0, std::sin(angle)));
    }
    const Instance one = partsInstance(1, test::boxesModel(boxes));
    Instance other = one;
    other.key = 2;
    const std::vector<std::string> warnings = bodyWarnings(*makeSnapshot({one, other}, {}, 1, 0, {}));
    ASSERT_EQ(warnings.size(), count == 8 ? 0u : 1u);
    if (warnings.empty()) continue;
    EXPECT_NE(warnings[0].find("ring: its 64 parts are up to "), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find(" % of its size, not 2 %"), std::string::npos) << warnings[0];
  }
}

TEST(SceneWorld, AMeshThatIsOpenIsReportedWithHowItCounts) {
  Model open = test::boxModel(Vec3::Constant(0.03));
  open.triangles.resize(10);
  const Instance one = partsInstance(1, open);
  const std::vector<std::string> warnings = bodyWarnings(*makeSnapshot({one}, {}, 1, 0, {}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "ring: its mesh is open at 4 edges and counts as a shell, 0.556 mm thick, of 0.01002 kg: set its mass "
            "(massKg), or close the mesh, or draw its walls with a thickness");
  BodySpec spec = one.body->spec;
  spec.mass_kg = 0.1;
  EXPECT_EQ(partsWarnings(one.shape, spec),
            (std::vector<std::string>{"its mesh is open at 4 edges and counts as a shell, 0.556 mm thick, of 0.1 kg: "
                                      "close the mesh, or draw its walls with a thickness"}));
}

}  // namespace
}  // namespace hl::test_scene_world
