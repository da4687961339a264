// Joints within the servo step: what a device's finger feels of doors, buttons and switches. Numbers R11.. are those of
// docs/bodies.md.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies/test_worlds.h"
#include "plain_servo.h"
#include "touch/body_world.h"
#include "touch/touch_step.h"

namespace hl::test_joint_world {
namespace {

constexpr double kRadius_m = 0.001, kStep_s = 1e-3, kSpring_N_m = 1000;

// One box on one joint to the world, without gravity, and a device's finger.
class JointBench {
 public:
  JointBench(double mass_kg, const Vec3& half, const Vec3& at, JointSpec joint) {
    BodySpec spec;
    spec.mass_kg = mass_kg;
    spec.shape = BodyShape::kBox;
    spec.surface = {0, 0, 0};
    Instance instance = test::instanceOf(test::boxModel(half), 1);
    joint.body_a = instance.key;
    instance.body = makeRigidBody("box", spec, {Mat3::Identity(), at}, instance.shape->bounds,
                                  {Vec3::Constant(-1), Vec3::Constant(1)});
    instance.driver = instance.body->poses;
    scenes_.emplace(makeSnapshot(std::vector<Instance>{instance}, {}, 1, 0, {Vec3::Zero(), {joint}}));
    loop_.emplace(*scenes_, ProxySettings{});
    arm(step_.servo());
    commands_.radius_W = kRadius_m;
  }

  // The finger is there at the begin of the step; the force on the hand.
  Vec3 step(const Vec3& finger) {
    DeviceSample sample;
    sample.time_ns = time_ns_ += 1'000'000;
    sample.position = finger;
    sample.status = DeviceStatus::kOk;
    return step_.onTime(*loop_, commands_, settings_, sample).force_N;
  }
  // From x = `from` to `to` in this time, and then held for `held_s`; the last force.
  Vec3 push(const Vec3& from, double to, double seconds, double held_s) {
    Vec3 finger = from, force = Vec3::Zero();
    for (double t = kStep_s; t < seconds + held_s; t += kStep_s) {
      finger.x() = from.x() + (to - from.x()) * std::min(1.0, t / seconds);
      force = step(finger);
    }
    return force;
  }
  const JointState& joint() const { return scenes_->bodies()->state().joints[0]; }

 private:
  std::optional<SnapshotSlot> scenes_;
  std::optional<ProxyLoop> loop_;
  TouchStep step_;
  ServoSettings settings_ = test::plainServo(kSpring_N_m, kStep_s);
  ProxyCommands commands_;
  std::int64_t time_ns_ = 0;
};

// 1 kg, 0.3 m from the hinge to the outermost place where the finger pushes; friction of 0.05 N m.
TEST(JointWorld, R11TheHandFeelsTheFrictionOfADoor) {
  for (const auto& [r, force_N] : {std::pair{0.3, 0.05 / 0.3}, std::pair{0.15, 0.05 / 0.15}}) {
    const Vec3 middle(0.002, 0.16, 0);
    JointSpec hinge;
    hinge.kind = JointKind::kHinge;
    hinge.anchor_W = Vec3(0.002, 0, 0);
    hinge.axis_W = Vec3::UnitZ();
    hinge.along.friction = 0.05;
    JointBench door(1, Vec3(0.002, 0.16, 0.1), middle, hinge);
    // What rings between finger and door decays by w^2 T / 2 = 1.3 and 0.33 / s, w^2 = K r^2 / I.
    const Vec3 force = door.push(Vec3(-0.002, r, 0), 0.001, 20, 0);
    EXPECT_NEAR(-force.x(), force_N, 1e-3 * force_N) << r;
    EXPECT_LT(door.joint().velocity, -1e-4);
  }
}

// A button of 20 g along x, its face at x = 0; `d` is how far the finger is pressed from there.
JointBench button(const JointForces& along) {
  const Vec3 middle(0.01, 0, 0);
  JointSpec slider;
  slider.kind = JointKind::kSlider;
  slider.anchor_W = middle;
  slider.along = along;
  return {0.02, Vec3::Constant(0.01), middle, slider};
}
Vec3 fingerAt(double d) { return {d - kRadius_m, 0, 0}; }

TEST(JointWorld, R12AButtonInSeriesWithTheSpring) {
  JointForces joint;
  joint.spring = 200;
  joint.damping = 1;
  JointBench bench = button(joint);
  for (const double d : {0.001, 0.003, 0.006}) {
    const Vec3 force = bench.push(fingerAt(d - 0.001), fingerAt(d).x(), 0.2, 0.8);
    EXPECT_NEAR(-force.x(), 166.6666667 * d, 1e-6);
    EXPECT_NEAR(bench.joint().coordinate, d / 1.2, 1e-8);
  }
}

// 1 N at 2 mm, where it falls to 0.6 N, then 500 N/m.
TEST(JointWorld, R13ASnap) {
  JointForces joint;
  joint.damping = 1;
  joint.table = {{0, 0.002, 0.002 + 1e-8, 0.012}, {0, -1, -0.6, -5.6}};
  JointBench bench = button(joint);
  bench.push(fingerAt(-0.001), fingerAt(0.0025).x(), 1, 1);
  const Vec3 before = bench.push(fingerAt(0.0025), fingerAt(0.00299).x(), 2, 1);
  const double at_before = bench.joint().coordinate;
  EXPECT_NEAR(-before.x(), 1 - 0.01 / 3, 1e-4);
  const Vec3 after = bench.push(fingerAt(0.00299), fingerAt(0.00301).x(), 0.5, 1);
  // Both are 10 um from 3 mm: 1/3 of it before the jump, 2/3 after it.
  EXPECT_NEAR(bench.joint().coordinate - at_before, 0.26667e-3 + 10e-6 / 1.5 + 10e-6 * 2 / 3, 1e-6);
  EXPECT_NEAR(-after.x(), 0.73333 + 0.01 / 3, 1e-4);
}

// Between 1 and 2 mm the force falls by `fall_N_m` per m. Where the finger is pressed so that the button would be
// at 1.5 mm, it comes there from both sides, or from neither.
TEST(JointWorld, R14ADetentJumpsFromTheStiffnessOfTheFingerOn) {
  for (const double fall_N_m : {800.0, 990.0, 1010.0, 1200.0}) {
    JointForces joint;
    joint.damping = 0.5;
    const double low_N = 1 - fall_N_m * 0.001;
    joint.table = {{0, 0.001, 0.002, 0.012}, {0, -1, -low_N, -low_N - 10}};
    const double d = 0.0015 + (1 - fall_N_m * 0.0005) / kSpring_N_m;
    for (const double begin : {0.0, 0.004}) {
      JointBench bench = button(joint);
      bench.push(fingerAt(-0.001), fingerAt(begin).x(), 1, 0.5);
      bench.push(fingerAt(begin), fingerAt(d).x(), 2, 2);
      const bool jumps = fall_N_m > kSpring_N_m;
      EXPECT_EQ(std::abs(bench.joint().coordinate - 0.0015) > 1e-5, jumps) << fall_N_m << " from " << begin;
      if (jumps) {
        EXPECT_EQ(bench.joint().coordinate < 0.0015, begin == 0) << fall_N_m;
      }
    }
  }
}

// A chain of six and one body beside it, each of 1 cm; one of the chain is placed outside of its room.
TEST(JointWorld, WhatIsJoinedToALostBodyIsPutBackWithIt) {
  constexpr std::uint64_t kChain = 6;
  for (std::uint64_t lost = 1; lost <= kChain + 1; ++lost) {
    std::vector<Instance> instances;
    std::vector<JointSpec> joints;
    for (std::uint64_t key = 1; key <= kChain + 1; ++key) {
      BodySpec spec;
      spec.mass_kg = 0.1;
      spec.shape = BodyShape::kBox;
      Instance instance = test::instanceOf(test::boxModel(Vec3::Constant(0.005)), key);
      instance.body = makeRigidBody("link", spec, {Mat3::Identity(), Vec3(0.02 * static_cast<double>(key), 0, 0)},
                                    instance.shape->bounds, {Vec3::Constant(-1), Vec3::Constant(1)});
      instance.driver = instance.body->poses;
      instances.push_back(instance);
    }
    for (std::uint64_t key = kChain; key > 1; --key) {
      JointSpec joint;
      joint.key = kChain + 1 - key;
      joint.kind = JointKind::kBall;
      joint.body_a = key;
      joint.body_b = key - 1;
      joint.anchor_W = Vec3(0.02 * static_cast<double>(key) - 0.01, 0, 0);
      joints.push_back(joint);
    }
    const auto scene = makeSnapshot(instances, {}, 1, 0, {Vec3::Zero(), joints});
    const auto world = BodyWorld::of(*scene);
    world->step(1'000'000, kStep_s, {});
    BodyCommand away;
    away.key = lost;
    away.position_m = Vec3(5, 0, 0);
    BodyCommands commands;
    commands.push(away);
    world->act(commands);
    world->step(2'000'000, kStep_s, {});
    EXPECT_EQ(world->view().returned, lost <= kChain ? kChain : 1U) << lost;
    for (std::uint64_t key = 1; key <= kChain + 1; ++key) {
      EXPECT_NEAR(world->state().bodies[key - 1].centre.x(), 0.02 * static_cast<double>(key), 1e-9) << lost;
    }
  }
}

}  // namespace
}  // namespace hl::test_joint_world
