// What joints report to other threads: coordinate, velocity and forces on the body that is named first.
#include "touch/joint_views.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "bodies/test_worlds.h"
#include "guard/realtime_guard.h"
#include "touch/body_world.h"

namespace hl::test_joint_views {
namespace {

constexpr double kMass_kg = 0.1, kWeight_N = 0.981, kSpring_N_m = 200;

Instance bodyInstance(std::uint64_t key, const Vec3& at, bool fixed) {
  Instance instance = test::instanceOf(test::boxModel(Vec3::Constant(0.02)), key);
  BodySpec spec;
  spec.mass_kg = kMass_kg;
  spec.shape = BodyShape::kBox;
  spec.fixed = fixed;
  setBody(instance, makeRigidBody("box", spec, {Mat3::Identity(), at}, instance.shape->bounds,
                                  {Vec3::Constant(-1), Vec3::Constant(1)}));
  return instance;
}

// A block, key 2, and one that is fixed, key 1; the joint is reported after each of two seconds' steps.
ShownJoint hangs(JointSpec joint) {
  joint.shown = std::make_shared<SharedJoint>();
  joint.key = 77;
  std::vector<Instance> instances{bodyInstance(1, Vec3(0.5, 0, 0), true), bodyInstance(2, Vec3::Zero(), false)};
  const auto scene =
      makeSnapshot(std::move(instances), {}, 1, 0, {Vec3(0, -kWeight_N / kMass_kg, 0), {std::move(joint)}});
  const auto world = BodyWorld::of(*scene);
  const RealtimeGuard guard;
  for (std::int64_t ms = 0; ms <= 2000; ++ms) world->step(ms * 1'000'000, 1e-3, {});
  EXPECT_EQ(world->view().awake, 0U) << "it sleeps";
  return scene->mechanics.joints[0].shown->read();
}

TEST(JointViews, ASpringReportsItsWayAndForce) {
  JointSpec slider;
  slider.kind = JointKind::kSlider;
  slider.axis_W = Vec3::UnitY();
  slider.along.spring = kSpring_N_m;
  slider.along.damping = 5;
  for (const bool block_first : {true, false}) {
    slider.body_a = block_first ? 2 : 1;
    slider.body_b = block_first ? 1 : 2;
    const ShownJoint shown = hangs(slider);
    const double sign = block_first ? 1 : -1;  // the fixed one rises against the block
    EXPECT_NEAR(shown.coordinate, -sign * kWeight_N / kSpring_N_m, 1e-6);
    EXPECT_NEAR(shown.force, sign * kWeight_N, 1e-3);
    EXPECT_EQ(shown.velocity, 0);
    EXPECT_NEAR(shown.held_N.norm(), 0, 1e-9);
  }
}

TEST(JointViews, WhatHoldsReportsItsForceOnTheFirst) {
  for (const JointKind kind : {JointKind::kBall, JointKind::kHinge, JointKind::kFixed, JointKind::kDistance}) {
    for (const bool block_first : {true, false}) {
      JointSpec joint;
      joint.kind = kind;
      joint.body_a = block_first ? 2 : 1;
      joint.body_b = block_first ? 1 : 2;
      joint.anchor_W = Vec3(0, block_first || kind != JointKind::kDistance ? 0 : 0.1, 0);
      joint.anchor_b_W = Vec3(0, block_first ? 0.1 : 0, 0);
      const ShownJoint shown = hangs(joint);
      const Vec3 expected(0, block_first ? kWeight_N : -kWeight_N, 0);
      EXPECT_NEAR((shown.held_N - expected).norm(), 0, 1e-6) << kJointKindNames[static_cast<std::size_t>(kind)];
      EXPECT_NEAR(shown.coordinate, kind == JointKind::kDistance ? 0.1 : 0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace hl::test_joint_views
