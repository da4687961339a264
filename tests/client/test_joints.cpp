// Joints by the calls: what is sent of them, what the state gives, and which calls are errors.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "client/fake_server.h"

namespace hl::client::test_joints {
namespace {

void expectJointError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

// Objects 3 and 4, bodies, called with names.
void callBodies() {
  for (const HLuint object : {3U, 4U}) {
    hlNewObject(object);
    hlBodyd(HL_BODY_MASS, 1);
    triangle();
    hlEndObject();
    hlLoadName(10 * object);
    hlCallObject(object);
  }
}

TEST_F(CallsTest, AJointIsSentWithTheWorldThatCallsItsBodies) {
  callBodies();
  hlJointi(HL_JOINT_KIND, HL_JOINT_HINGE);
  hlJointi(HL_JOINT_COLLIDE, HL_TRUE);
  hlJointd(HL_JOINT_LOW, -0.5);
  hlJointf(HL_JOINT_HIGH, 1.5F);
  hlJointd(HL_JOINT_REST, 0.25);
  hlJointd(HL_JOINT_SPRING, 2);
  hlJointd(HL_JOINT_DAMPING, 3);
  hlJointd(HL_JOINT_FRICTION, 4);
  hlPushMatrix();
  hlTranslated(1, 2, 3);
  hlRotated(90, 0, 0, 1);
  hlScaled(2, 2, 2);
  hlJoint3d(HL_JOINT_ANCHOR, 1, 0, 0);
  hlJoint3d(HL_JOINT_AXIS, 1, 0, 0);
  hlPopMatrix();
  const std::array<double, 2> positions{0, 0.002}, forces{0, -1};
  hlJointTable(2, positions.data(), forces.data());
  hlJoin(6, 3, 30, 4, 40);
  hlJoin(7, 4, 0, 0, 0);
  hlFlush();
  expectJointError(HL_NO_ERROR);
  const proto::World world = server->frames()[0].world();
  ASSERT_EQ(world.joints_size(), 2);
  const proto::WorldJoint& joint = world.joints(0);
  EXPECT_EQ(joint.id(), 6U);
  EXPECT_EQ(joint.body_a().object(), 3U);
  EXPECT_EQ(joint.body_a().name(), 30U);
  EXPECT_EQ(joint.body_b().object(), 4U);
  EXPECT_EQ(joint.body_b().name(), 40U);
  proto::Joint expected;
  expected.set_kind(proto::HINGE);
  expected.set_collide(true);
  expected.set_low(-0.5);
  expected.set_high(1.5);
  expected.set_rest(0.25);
  expected.set_spring(2);
  expected.set_damping(3);
  expected.set_friction(4);
  EXPECT_NEAR(joint.joint().anchor().x(), 1, 1e-15);  // the matrix turns x to y and doubles it
  EXPECT_NEAR(joint.joint().anchor().y(), 4, 1e-15);
  EXPECT_NEAR(joint.joint().anchor().z(), 3, 1e-15);
  EXPECT_NEAR(joint.joint().axis().y(), 1, 1e-15);
  *expected.mutable_anchor() = joint.joint().anchor();
  *expected.mutable_axis() = joint.joint().axis();
  expected.mutable_table()->mutable_position()->Add(positions.begin(), positions.end());
  expected.mutable_table()->mutable_force()->Add(forces.begin(), forces.end());
  EXPECT_EQ(joint.joint().DebugString(), expected.DebugString());
  EXPECT_EQ(world.joints(1).joint().DebugString(), proto::Joint().DebugString()) << "hlJoin begins afresh";
  EXPECT_FALSE(world.joints(1).body_a().has_name());
  EXPECT_FALSE(world.joints(1).has_body_b());
}

TEST_F(CallsTest, AClearDropsJointsAndTheNextFrameHasItsOwn) {
  callBodies();
  hlJoin(6, 3, 30, 4, 40);
  hlClear();
  hlCallObject(3);
  hlJoin(6, 3, 0, 0, 0);
  hlFlush();
  hlFrameInterval(0);
  hlGravity3d(0, 0, 0);
  hlFlush();
  expectJointError(HL_NO_ERROR);
  ASSERT_EQ(server->frames()[0].world().joints_size(), 1);
  EXPECT_FALSE(server->frames()[0].world().joints(0).has_body_b());
  EXPECT_FALSE(server->frames()[1].has_world()) << "it draws nothing: the joints stay";
}

TEST_F(CallsTest, JointsOutOfRangeAreErrorsAndNotSent) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  hlJointd(HL_JOINT_KIND, 1), expectJointError(HL_INVALID_ENUM);
  hlJointd(HL_JOINT_SPRING, -1), expectJointError(HL_INVALID_VALUE);
  hlJointd(HL_JOINT_FRICTION, std::nan("")), expectJointError(HL_INVALID_VALUE);
  hlJointd(HL_JOINT_HIGH, kInfinite), expectJointError(HL_INVALID_VALUE);
  hlJointi(HL_JOINT_SPRING, 1), expectJointError(HL_INVALID_ENUM);
  hlJointi(HL_JOINT_KIND, HL_BODY_BOX), expectJointError(HL_INVALID_ENUM);
  hlJoint3d(HL_JOINT_AXIS, 0, 0, 0), expectJointError(HL_INVALID_VALUE);
  hlJoint3d(HL_JOINT_AXIS, std::nan(""), 0, 1), expectJointError(HL_INVALID_VALUE);
  hlJoint3d(HL_JOINT_ANCHOR, 2e6, 0, 0), expectJointError(HL_INVALID_VALUE);
  hlJoint3d(HL_JOINT_LOW, 0, 0, 0), expectJointError(HL_INVALID_ENUM);
  const std::array<double, 2> falling{1, 0}, wrong{0, kInfinite};
  hlJointTable(2, falling.data(), falling.data()), expectJointError(HL_INVALID_VALUE);
  hlJointTable(2, wrong.data(), falling.data()), expectJointError(HL_INVALID_VALUE);
  hlJointTable(257, falling.data(), falling.data()), expectJointError(HL_INVALID_VALUE);
  hlJointTable(-1, falling.data(), falling.data()), expectJointError(HL_INVALID_VALUE);
  hlJointTable(1, nullptr, falling.data()), expectJointError(HL_INVALID_VALUE);
  hlNewObject(9);
  hlJointd(HL_JOINT_SPRING, 1), expectJointError(HL_INVALID_OPERATION);
  hlJoin(1, 9, 0, 0, 0), expectJointError(HL_INVALID_OPERATION);
  hlEndObject();
  hlJoin(1, 8, 0, 0, 0), expectJointError(HL_INVALID_VALUE);
  hlJoin(0, 9, 0, 0, 0), expectJointError(HL_INVALID_VALUE);
  hlJoin(1, 9, 0, 8, 0), expectJointError(HL_INVALID_VALUE);
  hlJoin(1, 9, 2, 9, 2), expectJointError(HL_INVALID_VALUE);
  hlFlush();
  expectJointError(HL_NO_ERROR);
  EXPECT_FALSE(server->frames()[0].has_world()) << "no joint was drawn";
}

TEST_F(CallsTest, AJointThatIsNotCompleteIsAnError) {
  callBodies();
  hlJointi(HL_JOINT_KIND, HL_JOINT_SLIDER);
  hlJoin(1, 3, 30, 0, 0), expectJointError(HL_INVALID_OPERATION);  // no axis
  hlJoint3d(HL_JOINT_AXIS, 0, 0, 1e-200);
  hlJointd(HL_JOINT_LOW, 1);
  hlJointd(HL_JOINT_HIGH, 0);
  hlJoin(1, 3, 30, 0, 0), expectJointError(HL_INVALID_OPERATION);
  hlJointi(HL_JOINT_KIND, HL_JOINT_DISTANCE);  // which resets the rest
  hlJointd(HL_JOINT_HIGH, -1);
  hlJoin(1, 3, 30, 0, 0), expectJointError(HL_INVALID_OPERATION);
  hlJointi(HL_JOINT_KIND, HL_JOINT_BALL);
  hlJointd(HL_JOINT_HIGH, 2);
  hlJoin(1, 3, 30, 0, 0), expectJointError(HL_INVALID_OPERATION);  // it has no coordinate
  hlJointi(HL_JOINT_KIND, HL_JOINT_SLIDER);
  hlJoint3d(HL_JOINT_AXIS, 0, 0, 1e-200);
  hlJointd(HL_JOINT_LOW, 1);
  hlJointd(HL_JOINT_LOW, std::nan("")), expectJointError(HL_INVALID_VALUE);
  hlJoin(1, 3, 30, 0, 0), expectJointError(HL_NO_ERROR);
  hlJoin(1, 4, 40, 0, 0), expectJointError(HL_INVALID_VALUE);  // the number is taken
  hlFlush();
  ASSERT_EQ(server->frames()[0].world().joints_size(), 1);
  EXPECT_EQ(server->frames()[0].world().joints(0).joint().low(), 1) << "errors change nothing";
  EXPECT_FALSE(server->frames()[0].world().joints(0).joint().has_high());
  EXPECT_EQ(server->frames()[0].world().joints(0).joint().axis().z(), 1);
}

TEST_F(CallsTest, TheStateGivesWhatJointsDo) {
  proto::ClientState& state = server->sendState();
  for (const std::uint32_t id : {8U, 5U}) {
    proto::JointState& joint = *state.add_joints();
    joint.set_id(id);
    joint.set_coordinate(0.1 * id);
    joint.set_velocity(2);
    joint.set_force(-3);
    joint.mutable_held_n()->set_y(id);
  }
  hlPoll();
  EXPECT_EQ(number(HL_JOINT_COUNT), 2);
  std::array<HLjoint, 3> joints{};
  ASSERT_EQ(hlGetJoints(3, joints.data()), 2);
  EXPECT_EQ(joints[0].joint, 5U);
  EXPECT_EQ(joints[1].hold[1], 8);
  std::array<double, 3> values{};
  EXPECT_EQ(hlGetJointdv(5, HL_JOINT_COORDINATE, values.data()), HL_TRUE);
  EXPECT_EQ(values[0], 0.5);
  EXPECT_EQ(hlGetJointdv(5, HL_JOINT_VELOCITY, values.data()), HL_TRUE);
  EXPECT_EQ(values[0], 2);
  EXPECT_EQ(hlGetJointdv(5, HL_JOINT_FORCE, values.data()), HL_TRUE);
  EXPECT_EQ(values[0], -3);
  EXPECT_EQ(hlGetJointdv(8, HL_JOINT_HOLD, values.data()), HL_TRUE);
  EXPECT_EQ(values[1], 8);
  EXPECT_EQ(hlGetJointdv(7, HL_JOINT_HOLD, values.data()), HL_FALSE);
  expectJointError(HL_NO_ERROR);
  hlGetJointdv(5, HL_JOINT_SPRING, values.data()), expectJointError(HL_INVALID_ENUM);
  hlGetJointdv(5, HL_JOINT_HOLD, nullptr), expectJointError(HL_INVALID_VALUE);
  hlGetJoints(-1, joints.data()), expectJointError(HL_INVALID_VALUE);
}

}  // namespace
}  // namespace hl::client::test_joints
