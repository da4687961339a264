// What a joint must hold to be stepped; force tables.
#include "bodies/joint_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "joint_worlds.h"

namespace hl::test_joint_check {
namespace {

using namespace test;

Joint goodHinge() { return named(7, 1, 0, jointAt(JointKind::kHinge, Vec3::Zero(), Vec3::UnitZ(), Pose())); }

// The line that says what is wrong with the hinge after `spoil`; empty: nothing.
std::string complaint(const std::function<void(Joint&)>& spoil) {
  World world = heavy({ball(1, 0.1, 0.01, 0), ball(2, 0.1, 0.01, 0)}, {goodHinge()});
  spoil(world.joints[0]);
  try {
    startWorld(world, {Pose(), placeAt(Vec3(0.1, 0, 0))});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(JointCheck, SaysWhichJointAndWhatIsWrong) {
  EXPECT_EQ(complaint([](Joint&) {}), "");
  EXPECT_EQ(complaint([](Joint& joint) { joint.body_a = 3; }), "joint 7: body_a is no body of the world");
  EXPECT_EQ(complaint([](Joint& joint) { joint.body_b = 1; }), "joint 7: body_a and body_b must be two bodies");
  EXPECT_EQ(complaint([](Joint& joint) { joint.spring = -1; }),
            "joint 7: spring, damping and friction must be finite and >= 0");
  EXPECT_EQ(complaint([](Joint& joint) { joint.low = 1, joint.high = 0; }), "joint 7: low must not exceed high");
  EXPECT_EQ(complaint([](Joint& joint) { joint.axis_a *= 2; }), "joint 7: axis and side must be unit");
  EXPECT_EQ(complaint([](Joint& joint) { joint.side_b = joint.axis_b; }), "joint 7: its side must be across its axis");
  EXPECT_EQ(complaint([](Joint& joint) { joint.anchor_a.x() = NAN; }), "joint 7: an anchor is not finite");
  EXPECT_EQ(complaint([](Joint& joint) { joint.low = NAN; }), "joint 7: low must not exceed high");
  EXPECT_EQ(complaint([](Joint& joint) { joint.kind = JointKind::kDistance, joint.low = joint.high = 0; }),
            "joint 7: its distance can only be 0: place its two anchors apart, or give it a limit high > 0");
  EXPECT_EQ(complaint([](Joint& joint) {
              joint.table = {{0, 0}, {1, 2}};
            }),
            "joint 7: the positions of its table must increase");
  EXPECT_EQ(complaint([](Joint& joint) {
              joint.table = {{0, 1}, {1}};
            }),
            "joint 7: its table must have a force for each position");
  EXPECT_NE(complaint([](Joint& joint) { joint.kind = JointKind::kBall, joint.friction = 1; }).find("no coordinate"),
            std::string::npos);
}

TEST(JointCheck, KeysIncrease) {
  World world = heavy({ball(1, 0.1, 0.01, 0)}, {goodHinge(), goodHinge()});
  EXPECT_THROW(checkWorld(world), Error);
  EXPECT_THROW(BodyStepper(std::make_shared<const World>(world)), Error);
  world.joints[1].key = 8;
  EXPECT_NO_THROW(checkWorld(world));
}

TEST(ForceTable, MeansAndEnergiesAreThoseOfItsLines) {
  const ForceTable table{{-1, 0, 2}, {3, 1, -1}};
  EXPECT_EQ(table.at(-5), 3);
  EXPECT_EQ(table.at(-0.5), 2);
  EXPECT_EQ(table.at(1), 0);
  EXPECT_EQ(table.at(9), -1);
  for (const auto& [from, to] :
       {std::pair{-3.0, 4.0}, std::pair{0.5, 0.7}, std::pair{1.0, -0.5}, std::pair{3.0, 3.5}}) {
    double sum = 0;
    const int parts = 100'000;
    for (int i = 0; i < parts; ++i) sum += table.at(from + (to - from) * (i + 0.5) / parts);
    EXPECT_NEAR(table.meanBetween(from, to), sum / parts, 1e-9);
    EXPECT_NEAR(table.energy_J(to) - table.energy_J(from), -table.meanBetween(from, to) * (to - from), 1e-12);
  }
  EXPECT_EQ(ForceTable().at(1), 0);
  EXPECT_EQ(ForceTable().energy_J(1), 0);
}

}  // namespace
}  // namespace hl::test_joint_check
