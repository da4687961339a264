// Rigid bodies of HL clients on a running server: how they come, move, are reported, pushed, and refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "bodies/body_problem.h"
#include "bodies/test_worlds.h"
#include "scene/scene_model.h"
#include "session/bodies_client.h"
#include "session/placed_client.h"
#include "touch/session_views.h"

namespace hl::test_bodies {
namespace {

using test::addBox;
using test::addMatrix;
using test::blocksFrame;
using test::kHalf_m;
using test::servoOf;
using test::set;
using test::settingsOf;
using test::vecOf;
using Client = test::BodiesClient;

class SessionBodiesTest : public testing::Test {
 protected:
  SessionBodiesTest() : server_(makeSnapshot(std::vector<Instance>{}), settingsOf()) { server_.start(); }
  TouchServer server_;
};

bool rests(const proto::BodyState& body, double height_m) {
  return std::abs(body.position().y() - height_m) < 1e-6 && vecOf(body.velocity_m_s()).norm() < 1e-6;
}

TEST_F(SessionBodiesTest, BlocksFallOntoTheFloorAndAreReported) {
  Client client(server_);
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0.5, 0.05, 0), Vec3(0.2, 0.03, 0)})), "");
  ASSERT_TRUE(client.until([&] {
    return client.state_.bodies_size() == 2 && rests(client.state_.bodies(0), kHalf_m) &&
           rests(client.state_.bodies(1), kHalf_m);
  }));
  EXPECT_EQ(client.state_.bodies(0).object(), 2U);
  EXPECT_EQ(client.state_.bodies(0).name(), 11U);
  EXPECT_NEAR(client.state_.bodies(1).position().x(), 0.2, 1e-9);
  const proto::Rotation& rotation = client.state_.bodies(0).rotation();
  EXPECT_NEAR(std::abs(rotation.w()), 1, 1e-9);
}

TEST_F(SessionBodiesTest, TheirImpactsAndSleepAreSentToTheClientThatAsks) {
  Client client(server_), silent(server_);
  EXPECT_NE(client.hear(-1), "");
  EXPECT_NE(client.hear(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(client.hear(0), "");
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0.5, kHalf_m + 0.05, 0)})), "");
  const auto heard = [&](proto::EventKind kind) -> const proto::Event* {
    for (const proto::Event& event : client.events_) {
      if (event.kind() == kind) return &event;
    }
    return nullptr;
  };
  ASSERT_TRUE(client.until([&] { return heard(proto::SLEEP) != nullptr; }));
  ASSERT_NE(heard(proto::IMPACT), nullptr);
  EXPECT_EQ(heard(proto::IMPACT)->object(), 2U);
  EXPECT_EQ(heard(proto::IMPACT)->name(), 11U);
  EXPECT_NEAR(heard(proto::IMPACT)->impulse_n_s(), 0.1 * std::sqrt(2 * 9.81 * 0.05), 0.01);
  EXPECT_LT(heard(proto::IMPACT)->time_s(), heard(proto::SLEEP)->time_s());
  proto::BodyCommand push;
  push.set_object(2);
  push.mutable_push()->mutable_impulse_n_s()->set_x(0.001);
  ASSERT_EQ(client.act(push), "");
  ASSERT_TRUE(client.until([&] { return heard(proto::WAKE) != nullptr; }));
  ASSERT_TRUE(silent.until([&] { return silent.state_.time_s() > heard(proto::WAKE)->time_s(); }));
  EXPECT_TRUE(silent.events_.empty());
}

TEST_F(SessionBodiesTest, ImpactsBelowWhatAClientHasSetAreNotSent) {
  Client client(server_);
  EXPECT_EQ(client.hear(1), "");
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0.5, kHalf_m + 0.05, 0)})), "");
  ASSERT_TRUE(client.until([&] { return !client.events_.empty(); }));
  EXPECT_EQ(client.events_[0].kind(), proto::SLEEP);
}

TEST_F(SessionBodiesTest, GoOnFromFrameToFrameAndJumpWhereTheyAreCalledElsewhere) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.05, 0)});
  ASSERT_EQ(client.show(frame), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return rests(body, kHalf_m); }));
  const auto before = server_.device().snapshot();
  frame.set_number(2);
  ASSERT_EQ(client.show(frame), "");
  const auto after = server_.device().snapshot();
  ASSERT_NE(before, after);
  EXPECT_EQ(before->instances[0].body ? before->instances[0].body : before->instances[1].body,
            after->instances[0].body ? after->instances[0].body : after->instances[1].body);
  const std::uint64_t steps = client.state_.servo().steps();
  ASSERT_TRUE(client.until([&] { return client.state_.servo().steps() > steps + 50; }));
  EXPECT_TRUE(rests(client.state_.bodies(0), kHalf_m));
  frame = blocksFrame(3, {Vec3(0.3, 0.2, 0)});
  ASSERT_EQ(client.show(frame), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().x() < 0.31; }));
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return rests(body, kHalf_m); }));
  // Of another mass at the same start it goes on.
  frame.set_number(4);
  frame.mutable_objects(1)->mutable_body()->set_mass_kg(0.2);
  ASSERT_EQ(client.show(frame), "");
  ASSERT_TRUE(client.until([&] { return client.state_.servo().steps() > steps + 500; }));
  EXPECT_TRUE(rests(client.state_.bodies(0), kHalf_m));
}

TEST_F(SessionBodiesTest, TheScaleOfACallIsPartOfTheShape) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {});
  proto::Item& call = *frame.mutable_world()->add_items();
  call.set_call(2);
  addMatrix(call, Vec3(0.5, 0.06, 0), 2);
  ASSERT_EQ(client.show(frame), "");
  EXPECT_TRUE(client.untilBody([](const proto::BodyState& body) { return rests(body, 2 * kHalf_m); }));
}

TEST_F(SessionBodiesTest, TheMatrixOfTheItemIsPartOfTheShapeToo) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.05, 0)});
  addMatrix(*frame.mutable_objects(1)->mutable_items(0), Vec3(0, kHalf_m, 0));  // its origin is at its foot
  ASSERT_EQ(client.show(frame), "");
  EXPECT_TRUE(client.untilBody([](const proto::BodyState& body) { return rests(body, 0); }));
}

TEST_F(SessionBodiesTest, TheNewestGravityCountsUntilItsSessionEnds) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.1, 0)});
  set(*frame.mutable_gravity_m_s2(), Vec3::Zero());
  ASSERT_EQ(client.show(frame), "");
  EXPECT_EQ(server_.device().snapshot()->mechanics.gravity_m_s2, Vec3(0, 0, 0));
  {
    Client other(server_);
    proto::Frame moon;
    moon.set_number(1);
    set(*moon.mutable_gravity_m_s2(), Vec3(0, -1.62, 0));
    ASSERT_EQ(other.show(moon), "");
    EXPECT_EQ(server_.device().snapshot()->mechanics.gravity_m_s2, Vec3(0, -1.62, 0));
  }
  ASSERT_TRUE(client.until([&] { return server_.device().snapshot()->mechanics.gravity_m_s2.y() == 0; }));
}

TEST_F(SessionBodiesTest, CommandsPushTurnAndPlaceThem) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.3, 0), Vec3(0.3, 0.3, 0)});
  set(*frame.mutable_gravity_m_s2(), Vec3::Zero());
  ASSERT_EQ(client.show(frame), "");
  proto::BodyCommand command;
  command.set_object(2);
  command.set_name(11);
  set(*command.mutable_push()->mutable_impulse_n_s(), Vec3(0.01, 0, 0));
  EXPECT_EQ(client.act(command), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) {  // P / m
    return (vecOf(body.velocity_m_s()) - Vec3(0.1, 0, 0)).norm() < 1e-12 && vecOf(body.spin_rad_s()).norm() == 0;
  }));
  EXPECT_EQ(vecOf(client.state_.bodies(1).velocity_m_s()).norm(), 0) << "of another name";
  command.mutable_push()->set_duration_s(0.05);
  EXPECT_EQ(client.act(command), "");
  ASSERT_TRUE(client.untilBody(
      [](const proto::BodyState& body) { return (vecOf(body.velocity_m_s()) - Vec3(0.2, 0, 0)).norm() < 1e-12; }));
  set(*command.mutable_velocity()->mutable_velocity_m_s(), Vec3::Zero());
  set(*command.mutable_velocity()->mutable_spin_rad_s(), Vec3(0, 0, 3));
  EXPECT_EQ(client.act(command), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.spin_rad_s().z() > 2.99; }));
  set(*command.mutable_place()->mutable_position(), Vec3(-0.2, 0.3, 0));
  command.mutable_place()->mutable_rotation()->set_w(2);
  EXPECT_EQ(client.act(command), "");
  ASSERT_TRUE(client.untilBody(
      [](const proto::BodyState& body) { return (vecOf(body.position()) - Vec3(-0.2, 0.3, 0)).norm() < 1e-9; }));
}

TEST_F(SessionBodiesTest, CommandsThatMakeNoSenseAreRefused) {
  Client client(server_);
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0.5, 0.05, 0)})), "");
  proto::BodyCommand command;
  command.set_object(2);
  EXPECT_EQ(client.act(command), "body_command needs a push, a velocity or a place");
  set(*command.mutable_push()->mutable_impulse_n_s(), Vec3(std::nan(""), 0, 0));
  EXPECT_NE(client.act(command), "");
  set(*command.mutable_push()->mutable_impulse_n_s(), Vec3(1, 0, 0));
  command.set_object(1);
  EXPECT_EQ(client.act(command), "body_command: no body of object 1 that moves is shown");
  command.set_object(2);
  command.set_name(99);
  EXPECT_EQ(client.act(command), "body_command: no body of object 2 and name 99 that moves is shown");
  command.clear_name();
  command.mutable_place()->mutable_rotation();
  EXPECT_EQ(client.act(command), "body_command.place.rotation must be a finite quaternion that is not 0");
  Client other(server_);
  set(*command.mutable_push()->mutable_impulse_n_s(), Vec3(1, 0, 0));
  EXPECT_EQ(other.act(command), "body_command: no body of object 2 that moves is shown") << "it is another client's";
}

TEST_F(SessionBodiesTest, ABodyThatCannotBeMadeRefusesTheFrameAndChangesNothing) {
  Client client(server_);
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0.5, 0.05, 0)})), "");
  const auto before = server_.device().snapshot();
  std::uint64_t last = 1;
  const auto refused = [&](const std::function<void(proto::Frame&)>& spoil) {
    proto::Frame frame = blocksFrame(1, {Vec3(0.5, 0.05, 0)});
    frame.set_number(++last);
    spoil(frame);
    return client.show(frame);
  };
  EXPECT_EQ(
      refused([](proto::Frame& frame) { frame.mutable_objects(1)->mutable_body()->set_mass_kg(-1); }).substr(0, 20),
      "object 2.body.massKg");
  EXPECT_EQ(refused([](proto::Frame& frame) {
              addBox(*frame.mutable_objects(1)->add_items()->mutable_primitives(), Vec3::Constant(0.1));
            }),
            "object 2.body: a body has one item, with primitives or an upload, and no calls; this one has 2 items");
  EXPECT_EQ(
      refused([](proto::Frame& frame) { frame.mutable_objects(1)->mutable_items(0)->set_call(1); }),
      "object 2.body: a body has one item, with primitives or an upload, and no calls; this one has 1 item, a call");
  EXPECT_EQ(refused([](proto::Frame& frame) {
              auto& vertices = *frame.mutable_objects(1)->mutable_items(0)->mutable_primitives()->mutable_vertices();
              for (int i = 1; i < vertices.size(); i += 3) vertices[i] = 0;
            }),
            "object 2.body: a body must have a thickness in all directions");
  EXPECT_NE(refused([](proto::Frame& frame) {
              set(*frame.mutable_gravity_m_s2(), Vec3(0, std::numeric_limits<double>::infinity(), 0));
            }),
            "");
  EXPECT_NE(refused([](proto::Frame& frame) {
              proto::VertexUpdate& moved = *frame.add_moved();
              moved.set_object(2);
              for (int i = 0; i < 3; ++i) moved.mutable_primitives()->add_vertices(0);
            }),
            "");
  EXPECT_EQ(server_.device().snapshot(), before);
}

TEST_F(SessionBodiesTest, ThereAreNoMoreThanTheLimitAllClientsTogether) {
  Client client(server_), other(server_);
  std::vector<Vec3> many;
  for (std::size_t i = 0; i < kMaxBodies; ++i) {
    const double x = static_cast<double>(i % 25), z = static_cast<double>(i / 25);
    many.emplace_back(0.05 * x, 0.5, 0.05 * z);
  }
  proto::Frame frame = blocksFrame(1, many);
  set(*frame.mutable_gravity_m_s2(), Vec3::Zero());
  ASSERT_EQ(client.show(frame), "");
  EXPECT_EQ(other.show(blocksFrame(1, {Vec3(-0.5, 0.05, 0)})),
            "there are more than 1000 bodies in the world, those of other clients among them");
  many.emplace_back(-0.5, 0.5, 0);
  EXPECT_EQ(client.show(blocksFrame(2, many)), "there are more than 1000 bodies in the world");
}

// Two boxes side by side are two parts.
TEST_F(SessionBodiesTest, EachOfTheirPartsCounts) {
  Client client(server_);
  const auto shown = [&](std::uint64_t number, std::size_t bodies) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < bodies; ++i)
      places.emplace_back(0.1 * static_cast<double>(i % 25), 0.5, 0.05 * static_cast<double>(i / 25));
    proto::Frame frame = blocksFrame(number, places);
    proto::ObjectDefinition& block = *frame.mutable_objects(1);
    block.mutable_body()->set_shape(proto::PARTS);
    proto::Primitives& mesh = *block.mutable_items(0)->mutable_primitives();
    const int numbers = mesh.vertices_size(), corners = mesh.triangles_size();
    for (int i = 0; i < numbers; ++i) mesh.add_vertices(mesh.vertices(i) + (i % 3 == 0 ? 2 * kHalf_m : 0));
    for (int i = 0; i < corners; ++i) mesh.add_triangles(mesh.triangles(i) + static_cast<std::uint32_t>(numbers / 3));
    return client.show(frame);
  };
  EXPECT_EQ(shown(1, kMaxBodies / 2 + 1),
            "there are more than 1000 bodies in the world, those of other clients among them");
  EXPECT_EQ(shown(2, 2), "");
}

// A box without lid, of which a call is said once.
TEST_F(SessionBodiesTest, AnOpenMeshOfPartsIsAWarningOfTheFrameThatBringsIt) {
  Client client(server_);
  proto::Frame frame = blocksFrame(1, {Vec3(0, 0.05, 0)});
  proto::ObjectDefinition& block = *frame.mutable_objects(1);
  block.mutable_body()->set_shape(proto::PARTS);
  block.mutable_items(0)->mutable_primitives()->mutable_triangles()->Truncate(30);
  ASSERT_EQ(client.show(frame), "");
  ASSERT_EQ(client.warnings_.size(), 1U);
  EXPECT_EQ(client.warnings_[0].find("object 2.body: its mesh is open at 4 edges and counts as a shell"), 0U)
      << client.warnings_[0];
  EXPECT_EQ(client.warnings_[0].find("massKg"), std::string::npos) << "it has a mass";
  frame.set_number(2);
  frame.clear_objects();
  ASSERT_EQ(client.show(frame), "");
  EXPECT_TRUE(client.warnings_.empty()) << client.warnings_[0];
}

TouchServerSettings withDevices(std::size_t count) {
  TouchServerSettings settings = settingsOf();
  settings.devices.clear();
  for (std::size_t i = 0; i < count; ++i) settings.devices.push_back({"hand" + std::to_string(i), "sim"});
  return settings;
}

// Sends the hand of one device there, again and again, until this holds.
bool send(TouchSession& hand, const Vec3& goal, Client& client, const std::function<bool()>& reached) {
  return client.until([&] {
    if (servoOf(hand).safety == SafetyState::kFault) hand.live().rearm();  // a busy machine
    hand.hand().setGoal(goal);
    return client.state_.bodies_size() > 0 && reached();
  });
}

TEST(Bodies, AreMovedByTheHandsOfAllDevices) {
  TouchServer server(makeSnapshot(std::vector<Instance>{}), withDevices(2));
  server.start();
  Client client(server);
  ASSERT_EQ(client.hear(0.01), "");
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0, 0.05, 0)})), "");
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().y() < 0.021; }));
  for (const std::size_t device : {0, 1}) {
    TouchSession& hand = server.device(device);
    const double side = device == 0 ? -1 : 1;
    const auto at = [&](const Vec3& place) {
      return (hand.live().workspace().toWorld(servoOf(hand).finger_D) - place).norm() < 0.005;
    };
    const auto block_m = [&] { return client.state_.bodies(0).position().x(); };
    const Vec3 above(side * 0.055, 0.06, 0), beside(side * 0.055, 0.02, 0);
    ASSERT_TRUE(send(hand, above, client, [&] { return at(above); }));
    ASSERT_TRUE(send(hand, beside, client, [&] { return at(beside); }));
    EXPECT_TRUE(send(hand, Vec3(0, 0.02, 0), client, [&] { return side * block_m() < -0.01; }));
    send(hand, above, client, [&] { return at(above); });
  }
  const auto struck = std::count_if(client.events_.begin(), client.events_.end(),
                                    [](const proto::Event& event) { return event.kind() == proto::IMPACT; });
  EXPECT_GE(struck, 1) << "it fell to the floor";
}

// Where nothing moves, each servo makes the ticks of its device again.
TEST(Bodies, LetTheServosTickAgainWhenTheyHaveGone) {
  TouchServer server(makeSnapshot(std::vector<Instance>{}), withDevices(2));
  server.start();
  Client client(server);
  ASSERT_EQ(client.show(blocksFrame(1, {Vec3(0.5, 0.05, 0)})), "");
  const auto ticks = [&] { return server.device(1).ticksInServoSteps(); };
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().y() < 0.03; }));
  const std::uint64_t before = ticks();
  ASSERT_TRUE(client.untilBody([](const proto::BodyState& body) { return body.position().y() < 0.021; }));
  EXPECT_EQ(ticks(), before);
  ASSERT_EQ(client.show(blocksFrame(2, {})), "");
  EXPECT_TRUE(client.until([&] { return ticks() > before + 100; }));
}

TEST(Bodies, HaveNoMoreHandsThanAWorldHas) {
  TouchServer server(makeSnapshot(std::vector<Instance>{}), withDevices(kMaxHands + 1));
  server.start();
  Client client(server);
  EXPECT_EQ(client.show(blocksFrame(1, {Vec3(0.5, 0.05, 0)})),
            "rigid bodies that move are touched by at most 8 devices, and the server has 9: give them fixed, or start "
            "fewer");
}

// What kBody_bytes stands for.
TEST(Bodies, AreCountedWithTheRoomThatTheirStepNeeds) {
  const std::size_t of_contact = sizeof(Meeting) + 2 * sizeof(Row) + sizeof(RememberedContact) + 2 * sizeof(Vec3);
  EXPECT_GE(kBody_bytes, 3 * kContactsPerBody * of_contact);
}

// Objects of a client that has gone stay, and count: a scene that has no room beside them is refused, and all goes on.
TEST(Bodies, ASceneIsRefusedWhereTheBodiesOfThoseThatHaveGoneLeaveNoRoom) {
  TouchServer server(makeSnapshot(std::vector<Instance>{}), settingsOf());
  server.start();
  const std::unique_ptr<PlacedClient> placed = server.placeClient();
  const auto block = makeShape(test::boxModel(Vec3::Constant(test::kHalf_m)), HierarchyKind::kBvh);
  BodySpec spec;
  spec.mass_kg = 0.1;
  PlacedList list;
  for (std::uint32_t i = 0; i < kMaxBodies; ++i) {
    PlacedShape one;
    one.shape = block;
    one.surfaces = surfacesOf(block);
    one.pose.origin = Vec3(0.1 * (i % 40), 1, 0.1 * (i / 40));
    one.key = i + 1;
    one.session = placed->session();
    one.body = std::make_shared<const BodySpec>(spec);
    list.push_back(one);
  }
  placed->place(std::make_shared<const PlacedList>(list), 0);
  SceneModel own;
  own.model.name = "own";
  own.bodies.resize(1);
  own.bodies[0].name = "block";
  own.bodies[0].model = test::boxModel(Vec3::Constant(test::kHalf_m));
  own.bodies[0].spec.mass_kg = 0.1;
  EXPECT_THROW(server.replaceScene(makeSnapshot(std::move(own))), Error);
  Client client(server);
  EXPECT_EQ(client.show(blocksFrame(1, {})), "") << "frames of others are shown as before";
}

}  // namespace
}  // namespace hl::test_bodies
