// What loaders say of a joint before its world is stepped.
#include "bodies/joint_start.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "joint_worlds.h"

namespace hl::test_joint_start {
namespace {

using namespace test;

// Bodies 1 and 2 move; no other does.
std::optional<Pose> start(std::uint64_t key) {
  if (key != 1 && key != 2) return {};
  return placeAt(Vec3(0.1 * static_cast<double>(key), 0, 0));
}

JointSpec jointOfKind(JointKind kind, std::uint64_t a = 1, std::uint64_t b = 0) {
  JointSpec joint;
  joint.kind = kind;
  joint.body_a = a;
  joint.body_b = b;
  return joint;
}

JointSpec limited(JointKind kind, double low, double high) {
  JointSpec joint = jointOfKind(kind);
  joint.along.low = low;
  joint.along.high = high;
  return joint;
}

constexpr double kNone = std::numeric_limits<double>::infinity();

TEST(JointStart, AJointToWhatDoesNotMoveIsOneToTheWorld) {
  const auto turned = steppedJoint(jointOfKind(JointKind::kHinge, 3, 2), start);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->body_a, 2U);
  EXPECT_EQ(turned->body_b, 0U);
  EXPECT_EQ(turned->axis_a, -Vec3::UnitX());
  EXPECT_EQ(steppedJoint(jointOfKind(JointKind::kBall, 3, 0), start), std::nullopt);
  EXPECT_EQ(steppedJoint(jointOfKind(JointKind::kBall, 1, 2), start)->body_b, 2U);
}

TEST(JointStart, AFaultIsThatOfTheStep) {
  EXPECT_EQ(startFault(jointOfKind(JointKind::kHinge), start), "");
  EXPECT_EQ(startFault(jointOfKind(JointKind::kDistance), start),
            "its distance can only be 0: place its two anchors apart, or give it a limit high > 0");
  EXPECT_EQ(startFault(jointOfKind(JointKind::kDistance, 3, 0), start), "") << "it is none";
  EXPECT_EQ(startFault(jointOfKind(JointKind::kBall, 1, 1), start), "body_a and body_b must be two bodies");
  JointSpec table = jointOfKind(JointKind::kSlider);
  table.along.table = {{0, 0}, {1, 2}};
  EXPECT_EQ(startFault(table, start), "the positions of its table must increase");
  EXPECT_EQ(startFault(limited(JointKind::kBall, -1, 1), start).substr(0, 40),
            "a ball or fixed joint has no coordinate:");
}

TEST(JointStart, OneThatJoinsNothingThatMovesIsReported) {
  const std::string nothing = "joins nothing that moves, and has no effect";
  EXPECT_EQ(startWarning(jointOfKind(JointKind::kBall, 3, 0), start), nothing);
  EXPECT_EQ(startWarning(jointOfKind(JointKind::kBall, 3, 4), start), nothing);
  EXPECT_EQ(startWarning(jointOfKind(JointKind::kBall, 3, 2), start), "");
}

TEST(JointStart, ACoordinateOutsideItsLimitsIsReported) {
  const std::string stays = ", and stays there until something moves it";
  EXPECT_EQ(startWarning(limited(JointKind::kHinge, 0.5, 1.6), start),
            "starts at 0 rad, outside its limits of 0.5 .. 1.6 rad" + stays);
  EXPECT_EQ(startWarning(limited(JointKind::kSlider, -kNone, -0.02), start),
            "starts at 0 m, outside its limits of -inf .. -0.02 m" + stays);
  JointSpec turned = limited(JointKind::kSlider, -kNone, -0.02);
  turned.body_a = 3, turned.body_b = 1;
  EXPECT_EQ(startWarning(turned, start).substr(0, 15), "starts at 0 m, ");
  JointSpec rope = limited(JointKind::kDistance, 0, 0.1);
  rope.anchor_b_W = Vec3(0, 0.25, 0);
  EXPECT_EQ(startWarning(rope, start), "starts at 0.25 m, outside its limits of 0 .. 0.1 m" + stays);
  rope.along.high = 0.25;
  EXPECT_EQ(startWarning(rope, start), "");
  rope.along.low = rope.along.high = 0.1;
  EXPECT_EQ(startWarning(rope, start), "") << "a rod goes to its length";
  EXPECT_EQ(startWarning(limited(JointKind::kHinge, 0, 1.6), start), "");
  EXPECT_EQ(startWarning(limited(JointKind::kSlider, 0.02, 0.02), start),
            "starts at 0 m, outside its limits of 0.02 .. 0.02 m" + stays);
}

// The page saves scenes in single precision, with coordinates counted from where they are.
TEST(JointStart, RoundingIsNotOutside) {
  EXPECT_EQ(startWarning(limited(JointKind::kHinge, 1e-7, 1), start), "");
  EXPECT_EQ(startWarning(limited(JointKind::kSlider, -0.1, -1e-8), start), "");
  EXPECT_NE(startWarning(limited(JointKind::kSlider, -0.1, -1e-6), start), "");
  EXPECT_NE(startWarning(limited(JointKind::kSlider, 0.01, 1e9), start), "") << "a far limit rounds no near one";
}

// What the warning says of it.
TEST(JointStart, WhatIsOutsideItsLimitsIsNotBroughtBack) {
  constexpr double kLow_m = 0.02;
  Joint slider = *steppedJoint(limited(JointKind::kSlider, kLow_m, 0.03), start);
  slider.key = 7;
  Playground play(weightless({ball(1, 0.1, 0.01, 0)}, {slider}), {*start(1)});
  play.steps(500);
  EXPECT_LT(play.state.joints[0].coordinate, 0.1 * kLow_m);
}

}  // namespace
}  // namespace hl::test_joint_start
