// Joints of HL clients on a running server: how they come, hold, go on, are reported, and refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "bodies/joint_set.h"
#include "bodies/test_worlds.h"
#include "record/recorder.h"
#include "record/replay.h"
#include "scene/scene_model.h"
#include "session/bodies_client.h"
#include "temp_folder.h"
#include "touch/body_world.h"

namespace hl::test_joints {
namespace {

using test::addMatrix;
using test::blocksFrame;
using test::set;
using test::settingsOf;
using test::vecOf;
using Client = test::BodiesClient;

constexpr double kMass_kg = 0.1, kGravity_m_s2 = 9.81;

// Of the call of object 2 named `a` with that named `b`; 0: with the world.
proto::WorldJoint& addJoint(proto::Frame& frame, std::uint32_t id, proto::JointKind kind, std::uint32_t a,
                            std::uint32_t b = 0) {
  proto::WorldJoint& joint = *frame.mutable_world()->add_joints();
  joint.set_id(id);
  joint.mutable_joint()->set_kind(kind);
  joint.mutable_body_a()->set_object(2);
  joint.mutable_body_a()->set_name(a);
  if (b == 0) return joint;
  joint.mutable_body_b()->set_object(2);
  joint.mutable_body_b()->set_name(b);
  return joint;
}

// A block that hangs on a spring of 200 N/m, which lets it down by m g / k.
proto::Frame hangingFrame(std::uint64_t number) {
  proto::Frame frame = blocksFrame(number, {Vec3(0.5, 0.3, 0)});
  proto::Joint& slider = *addJoint(frame, 7, proto::SLIDER, 11).mutable_joint();
  set(*slider.mutable_axis(), Vec3(0, 2, 0));
  slider.set_spring(200);
  slider.set_damping(5);
  return frame;
}
constexpr double kSag_m = kMass_kg * kGravity_m_s2 / 200;

bool hangs(const Client& client) {
  return client.state_.joints_size() == 1 && std::abs(client.state_.joints(0).coordinate() + kSag_m) < 1e-6 &&
         std::abs(client.state_.joints(0).velocity()) < 1e-6;
}

class SessionJointsTest : public testing::Test {
 protected:
  SessionJointsTest() : server_(makeSnapshot(std::vector<Instance>{}), settingsOf()) { server_.start(); }
  TouchServer server_;
};

TEST_F(SessionJointsTest, ASpringHoldsTheWeightAndReportsIt) {
  Client client(server_);
  ASSERT_EQ(client.show(hangingFrame(1)), "");
  ASSERT_TRUE(client.until([&] { return hangs(client); }));
  const proto::JointState& joint = client.state_.joints(0);
  EXPECT_EQ(joint.id(), 7U);
  EXPECT_NEAR(joint.force(), kMass_kg * kGravity_m_s2, 1e-3);
  EXPECT_NEAR(vecOf(joint.held_n()).norm(), 0, 1e-9) << "nothing pulls across the axis";
  EXPECT_NEAR(client.state_.bodies(0).position().y(), 0.3 - kSag_m, 1e-6);
  Client other(server_);
  ASSERT_TRUE(other.until([&] { return other.state_.servo().steps() > 0; }));
  EXPECT_EQ(other.state_.joints_size(), 0) << "they are another client's";
}

TEST_F(SessionJointsTest, GoesOnFromFrameToFrameAndAnewWhereItsBodyIsCalledElsewhere) {
  Client client(server_);
  ASSERT_EQ(client.show(hangingFrame(1)), "");
  ASSERT_TRUE(client.until([&] { return hangs(client); }));
  const auto before = server_.device().snapshot();
  ASSERT_EQ(client.show(hangingFrame(2)), "");
  const auto after = server_.device().snapshot();
  ASSERT_NE(before, after);
  EXPECT_EQ(before->mechanics.joints, after->mechanics.joints);
  for (int i = 0; i < 50; ++i) {
    const std::uint64_t steps = client.state_.servo().steps();
    ASSERT_TRUE(client.until([&] { return client.state_.servo().steps() > steps; }));
    ASSERT_NEAR(client.state_.joints(0).coordinate(), -kSag_m, 1e-5);
  }
  proto::Frame frame = hangingFrame(3);  // 40 mm lower: there the coordinate is 0
  frame.mutable_world()->mutable_items(1)->set_matrix(13, 0.26);
  ASSERT_EQ(client.show(frame), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().y() < 0.26; }));
  ASSERT_TRUE(client.until([&] { return hangs(client); }));
  EXPECT_NEAR(client.state_.bodies(0).position().y(), 0.26 - kSag_m, 1e-6);
}

TEST_F(SessionJointsTest, AFrameWithoutWorldLeavesThemAndOneWithoutJointsTakesThemAway) {
  Client client(server_);
  ASSERT_EQ(client.show(hangingFrame(1)), "");
  proto::Frame frame;
  frame.set_number(2);
  set(*frame.mutable_gravity_m_s2(), Vec3(0, -kGravity_m_s2, 0));
  ASSERT_EQ(client.show(frame), "");
  ASSERT_TRUE(client.until([&] { return hangs(client); }));
  frame = hangingFrame(3);
  frame.mutable_world()->clear_joints();
  ASSERT_EQ(client.show(frame), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().y() < 0.1; })) << "it falls";
  EXPECT_EQ(client.state_.joints_size(), 0);
}

// Both hang: the world holds twice the weight, and the two hold one.
TEST_F(SessionJointsTest, TwoBodiesHangOnEachOther) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.3, 0), Vec3(0.5, 0.2, 0)});
  set(*addJoint(frame, 2, proto::BALL_JOINT, 12, 11).mutable_joint()->mutable_anchor(), Vec3(0.5, 0.25, 0));
  set(*addJoint(frame, 1, proto::BALL_JOINT, 11).mutable_joint()->mutable_anchor(), Vec3(0.5, 0.35, 0));
  ASSERT_EQ(client.show(frame), "");
  const double weight_N = kMass_kg * kGravity_m_s2;
  ASSERT_TRUE(client.until([&] {
    return client.state_.joints_size() == 2 &&
           (vecOf(client.state_.joints(0).held_n()) - Vec3(0, 2 * weight_N, 0)).norm() < 1e-3;
  }));
  EXPECT_EQ(client.state_.joints(0).id(), 1U);
  EXPECT_LT((vecOf(client.state_.joints(1).held_n()) - Vec3(0, weight_N, 0)).norm(), 1e-3);
  EXPECT_EQ(client.state_.joints(1).coordinate(), 0) << "a ball has none";
}

// A fixed body stands for the world, whichever of the two it is.
TEST_F(SessionJointsTest, AFixedBodyIsTheWorld) {
  Client client(server_);
  proto::Frame frame = hangingFrame(1);
  frame.mutable_objects(0)->mutable_body()->set_fixed(true);
  proto::WorldJoint& joint = *frame.mutable_world()->mutable_joints(0);
  *joint.mutable_body_b() = joint.body_a();
  joint.mutable_body_a()->clear_name();
  joint.mutable_body_a()->set_object(1);
  ASSERT_EQ(client.show(frame), "");
  // The coordinate is that of the floor against the block: it rises as the block sinks.
  EXPECT_TRUE(client.until([&] {
    return client.state_.joints_size() == 1 && std::abs(client.state_.joints(0).coordinate() - kSag_m) < 1e-6;
  }));
}

TEST_F(SessionJointsTest, OneThatMakesNoSenseRefusesTheFrameAndChangesNothing) {
  Client client(server_);
  ASSERT_EQ(client.show(hangingFrame(1)), "");
  const auto before = server_.device().snapshot();
  std::uint64_t last = 1;
  const auto refused = [&](const std::function<void(proto::WorldJoint&)>& spoil) {
    proto::Frame frame = hangingFrame(++last);
    spoil(*frame.mutable_world()->mutable_joints(0));
    return client.show(frame);
  };
  using Spoiled = proto::WorldJoint;
  EXPECT_EQ(refused([](Spoiled& j) { j.set_id(0); }), "world.joints[0].id must not be 0");
  EXPECT_EQ(refused([](Spoiled& j) { j.clear_body_a(); }), "joint 7.bodyA.object must not be 0");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_body_a()->set_name(12); }),
            "joint 7: the world calls no body of object 2 and name 12: draw one, or the world without the joint");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_body_a()->set_object(9); }),
            "joint 7: the world calls no body of object 9 and name 11: draw one, or the world without the joint");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_body_b()->set_object(1); }),
            "joint 7: the world calls no body of object 1: draw one, or the world without the joint");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_body_b()->set_object(2); }), "joint 7: it joins a body to itself");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_joint()->set_body_a("floor"); }),
            "joint 7.joint: name, bodyA and bodyB are of scene files: leave them out");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_joint()->clear_axis(); }), "joint 7: a hinge or slider needs an axis");
  EXPECT_EQ(refused([](Spoiled& j) {
              j.mutable_joint()->set_low(1);
              j.mutable_joint()->set_high(0);
            }),
            "joint 7.low must not be above high");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_joint()->set_kind(proto::FIXED); }),
            "joint 7: a ball or fixed joint has no coordinate: leave out limits, spring, damping, friction and table");
  for (const double value : {std::nan(""), -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(refused([&](Spoiled& j) { j.mutable_joint()->set_spring(value); }).substr(0, 14), "joint 7.spring");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_joint()->mutable_anchor()->set_y(std::nan("")); }).substr(0, 16),
            "joint 7.anchor.y");
  EXPECT_EQ(refused([](Spoiled& j) { j.mutable_joint()->mutable_table()->add_position(1); }),
            "joint 7.table: a force table must have as many forces as positions");
  EXPECT_EQ(server_.device().snapshot(), before);
}

TEST_F(SessionJointsTest, WhatIsNotClearIsRefused) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.3, 0), Vec3(0.4, 0.3, 0)});
  addJoint(frame, 1, proto::FIXED, 11).mutable_body_a()->clear_name();
  EXPECT_EQ(client.show(frame), "joint 1: the world calls several bodies of object 2: give each call its own name");
  frame = blocksFrame(2, {Vec3(0.5, 0.3, 0), Vec3(0.4, 0.3, 0)});
  addJoint(frame, 1, proto::FIXED, 11, 12);
  addJoint(frame, 1, proto::FIXED, 11);
  EXPECT_EQ(client.show(frame), "joint 1 is there twice");
  frame = blocksFrame(3, {Vec3(0.5, 0.3, 0)});
  frame.mutable_objects(1)->mutable_body()->set_fixed(true);
  addJoint(frame, 1, proto::FIXED, 11);
  EXPECT_EQ(client.show(frame), "joint 1: of what it joins, nothing moves");
}

TEST(SessionJoints, ThereAreNoMoreThanTheLimitAllClientsTogether) {
  TouchServerSettings settings = settingsOf();
  settings.limits.joints = 3;
  TouchServer server(makeSnapshot(std::vector<Instance>{}), settings);
  server.start();
  Client client(server), other(server);
  const auto frame = [](std::uint64_t number, std::uint32_t joints) {
    proto::Frame made = blocksFrame(number, {Vec3(0.5, 0.3, 0), Vec3(0.4, 0.3, 0)});
    for (std::uint32_t id = 1; id <= joints; ++id) addJoint(made, id, proto::FIXED, 11, id % 2 == 0 ? 12 : 0);
    return made;
  };
  EXPECT_EQ(client.show(frame(1, 4)), "there are more than 3 joints in the world");
  EXPECT_EQ(client.show(frame(2, 2)), "");
  EXPECT_EQ(other.show(frame(1, 2)), "there are more than 3 joints in the world, those of other clients among them");
  EXPECT_EQ(other.show(frame(2, 1)), "");
  EXPECT_EQ(server.device().snapshot()->mechanics.joints.size(), 3U);
}

// A block on a spring, of the server's own scene: of another one the joint holds that one's block.
TEST(SessionJoints, OfTheServersOwnSceneFollowItsBodiesWhereItIsReplaced) {
  const auto scene = [] {
    SceneModel model;
    SceneBody body;
    body.name = "block";
    body.model = test::boxModel(Vec3::Constant(test::kHalf_m));
    body.pose.origin = Vec3(0.5, 0.3, 0);
    body.spec.mass_kg = kMass_kg;
    model.bodies.push_back(body);
    JointSpec joint;
    joint.kind = JointKind::kFixed;
    joint.body_a = 1;
    model.mechanics.joints.push_back(joint);
    return makeSnapshot(std::move(model));
  };
  TouchServer server(scene(), settingsOf());
  server.start();
  for (int i = 0; i < 3; ++i) {
    const auto shown = server.device().snapshot();
    EXPECT_EQ(shown->mechanics.joints.at(0).body_a, shown->instances.at(0).key);
    EXPECT_EQ(BodyWorld::of(*withOwnBodies(*shown))->world().joints.size(), 1U);
    server.replaceScene(scene());
  }
}

// Frames that bring joints, change and take them while a body swings: each tick and the world after it are the same.
TEST(SessionJoints, ARecordedSessionIsReplayedBitForBit) {
  const test::TempFolder folder;
  RecorderSettings recorder;
  recorder.file = (folder.path() / "joints.hlr").string();
  TouchServerSettings settings = settingsOf();
  settings.touch.sink = recorderWith(recorder);
  {
    TouchServer server(makeSnapshot(std::vector<Instance>{}), settings);
    server.start();
    Client client(server);
    ASSERT_EQ(client.show(hangingFrame(1)), "");
    ASSERT_TRUE(client.until([&] { return hangs(client); }));
    proto::Frame frame = hangingFrame(2);
    frame.mutable_world()->mutable_joints(0)->mutable_joint()->set_spring(100);
    addJoint(frame, 8, proto::DISTANCE, 11).mutable_joint()->set_high(0.6);
    ASSERT_EQ(client.show(frame), "");
    ASSERT_TRUE(client.until([&] { return client.state_.joints_size() == 2; }));
    ASSERT_TRUE(client.until([&] { return client.state_.joints(0).coordinate() < -1.9 * kSag_m; }));
    frame = hangingFrame(3);
    frame.mutable_world()->clear_joints();
    ASSERT_EQ(client.show(frame), "");
    ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().y() < 0.2; }));
  }
  const ReplayReport report = replay(recorder.file);
  EXPECT_FALSE(report.difference) << report.difference->what << " " << report.difference->number << " "
                                  << report.difference->text;
  EXPECT_GE(report.scenes, 4U);
  EXPECT_GT(report.world_hashes, 0U);
}

// What kJoint_bytes stands for: the blocks and links of both solves of a step.
TEST(SessionJoints, AreCountedWithTheRoomThatTheirStepNeeds) {
  constexpr std::size_t kLink_bytes = 3 * sizeof(Mat6) + 4 * sizeof(Vec6);
  EXPECT_GE(kJoint_bytes, 3 * (sizeof(Joint) + sizeof(JointState) + 2 * (sizeof(JointBlock) + kLink_bytes)));
}

}  // namespace
}  // namespace hl::test_joints
