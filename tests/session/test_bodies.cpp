// Rigid bodies of HL clients on a running server: how they come, move, are told of, pushed, and refused.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "base/error.h"
#include "bodies/body_problem.h"
#include "session/touch_server.h"

namespace hl {
namespace {

constexpr auto kPatience = std::chrono::seconds(60);  // no test waits so long unless it fails
constexpr double kHalf_m = 0.02;

TouchServerSettings settingsOf() {
  TouchServerSettings settings;
  settings.touch.explore = false;
  settings.touch.world_per_device = 1;
  return settings;
}

void addBox(proto::Primitives& out, const Vec3& half) {
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) out.add_vertices((i >> axis & 1) != 0 ? half[axis] : -half[axis]);
  }
  for (const std::uint32_t i : {0U, 2U, 3U, 0U, 3U, 1U, 4U, 5U, 7U, 4U, 7U, 6U, 0U, 1U, 5U, 0U, 5U, 4U,
                                2U, 6U, 7U, 2U, 7U, 3U, 0U, 4U, 6U, 0U, 6U, 2U, 1U, 3U, 7U, 1U, 7U, 5U})
    out.add_triangles(i);
}

void addMatrix(proto::Item& item, const Vec3& origin, double scale = 1) {
  for (const double v :
       {scale, 0., 0., 0., 0., scale, 0., 0., 0., 0., scale, 0., origin.x(), origin.y(), origin.z(), 1.})
    item.add_matrix(v);
}

// Object 1: a floor of 2 m whose top is at y = 0. Object 2: a block of 100 g, a body. The hand is near the origin.
proto::Frame blocksFrame(std::uint64_t number, const std::vector<Vec3>& blocks) {
  proto::Frame frame;
  frame.set_number(number);
  proto::ObjectDefinition& floor = *frame.add_objects();
  floor.set_id(1);
  addBox(*floor.add_items()->mutable_primitives(), Vec3(1, 0.05, 1));
  proto::ObjectDefinition& block = *frame.add_objects();
  block.set_id(2);
  addBox(*block.add_items()->mutable_primitives(), Vec3::Constant(kHalf_m));
  block.mutable_body()->set_mass_kg(0.1);
  block.mutable_body()->set_shape(proto::BOX);
  proto::Item& ground = *frame.mutable_world()->add_items();
  ground.set_call(1);
  addMatrix(ground, Vec3(0, -0.05, 0));
  std::uint32_t name = 10;
  for (const Vec3& place : blocks) {
    proto::Item& call = *frame.mutable_world()->add_items();
    call.set_call(2);
    call.set_name(++name);
    addMatrix(call, place);
  }
  return frame;
}

void set(proto::Vec3& out, const Vec3& v) {
  out.set_x(v.x());
  out.set_y(v.y());
  out.set_z(v.z());
}
Vec3 vecOf(const proto::Vec3& v) { return {v.x(), v.y(), v.z()}; }

class Client {
 public:
  explicit Client(TouchServer& server) : session_(server.connect([] {})) {
    proto::ClientMessage message;
    message.mutable_open()->set_protocol_version(1);
    message.mutable_open()->set_master(true);
    message.mutable_open()->set_state_rate_hz(1000);
    session_->receive(message);
    proto::ClientMessage request;
    request.mutable_body_request()->set_wanted(true);
    session_->receive(request);
  }

  /// What it was refused for; "" when it is shown.
  std::string show(const proto::Frame& frame) {
    proto::ClientMessage message;
    *message.mutable_frame() = frame;
    refusal_.clear();
    session_->receive(message);
    EXPECT_TRUE(until([&] { return shown_ == frame.number() || !refusal_.empty(); }));
    return refusal_;
  }
  std::string act(const proto::BodyCommand& command) {
    proto::ClientMessage message;
    *message.mutable_body_command() = command;
    refusal_.clear();
    session_->receive(message);
    proto::ServerReply reply;
    while (session_->take(reply)) remember(reply);
    return refusal_;
  }
  bool until(const std::function<bool()>& reached) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!reached()) {
      proto::ServerReply reply;
      while (session_->take(reply)) remember(reply);
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  /// Until so many bodies are told of that this holds for the first.
  bool untilBody(const std::function<bool(const proto::BodyState&)>& holds) {
    return until([&] { return state_.bodies_size() > 0 && holds(state_.bodies(0)); });
  }
  void remember(const proto::ServerReply& reply) {
    if (reply.has_state()) state_ = reply.state();
    if (reply.has_frame_shown()) shown_ = reply.frame_shown().number();
    if (reply.has_refusal()) refusal_ = reply.refusal().text();
  }

  std::unique_ptr<ClientSession> session_;
  proto::ClientState state_;
  std::string refusal_;
  std::uint64_t shown_ = 0;
};

class SessionBodiesTest : public testing::Test {
 protected:
  SessionBodiesTest() : server_(makeSnapshot(std::vector<Instance>{}), settingsOf()) { server_.start(); }
  TouchServer server_;
};

bool rests(const proto::BodyState& body, double height_m) {
  return std::abs(body.position().y() - height_m) < 1e-6 && vecOf(body.velocity_m_s()).norm() < 1e-6;
}

TEST_F(SessionBodiesTest, BlocksFallOntoTheFloorAndAreToldOf) {
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
  for (std::size_t i = 0; i < kMostBodies; ++i) {
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

TEST(Bodies, NeedAServerWithOneDevice) {
  TouchServerSettings settings = settingsOf();
  settings.devices = 2;
  TouchServer server(makeSnapshot(std::vector<Instance>{}), settings);
  server.start();
  Client client(server);
  EXPECT_NE(client.show(blocksFrame(1, {Vec3(0.5, 0.05, 0)})).find("several devices"), std::string::npos);
}

// What kBody_bytes stands for.
TEST(Bodies, AreCountedWithTheRoomThatTheirStepNeeds) {
  const std::size_t of_contact = sizeof(Meeting) + 2 * sizeof(Row) + sizeof(RememberedContact) + 2 * sizeof(Vec3);
  EXPECT_GE(kBody_bytes, 3 * kContactsPerBody * of_contact);
}

}  // namespace
}  // namespace hl
