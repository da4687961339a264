// Rigid bodies by the calls: what is sent of them, what the state gives, and which calls are errors.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_bodies {
namespace {

void expectCallError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

void defineTriangle(HLuint object) {
  hlNewObject(object);
  hlBodyd(HL_BODY_MASS, 0.25);
  hlBodyf(HL_BODY_DYNAMIC_FRICTION, 0.5F);
  hlBodyd(HL_BODY_RESTITUTION, 1);
  hlBodyi(HL_BODY_SHAPE, HL_BODY_PARTS);
  hlBody3d(HL_BODY_SPIN, 1, 2, 3);
  triangle();
  hlEndObject();
}

TEST_F(CallsTest, ABodyIsSentWithItsObject) {
  defineTriangle(3);
  hlGravity3d(0, -1.62, 0);
  hlCallObject(3);
  hlFlush();
  expectCallError(HL_NO_ERROR);
  const auto frames = server->frames();
  ASSERT_EQ(frames.size(), 1U);
  const proto::Body& body = frames[0].objects(0).body();
  EXPECT_EQ(body.mass_kg(), 0.25);
  EXPECT_FALSE(body.has_density_kg_m3());
  EXPECT_EQ(body.dynamic_friction(), 0.5);
  EXPECT_FALSE(body.has_static_friction());
  EXPECT_EQ(body.restitution(), 1);
  EXPECT_EQ(body.shape(), proto::PARTS);
  EXPECT_EQ(body.spin_rad_s().z(), 3);
  EXPECT_FALSE(body.fixed());
  EXPECT_EQ(frames[0].gravity_m_s2().y(), -1.62);
  ASSERT_TRUE(server->received[0].has_body_request()) << "states are to tell of bodies from now on";
  EXPECT_TRUE(server->received[0].body_request().wanted());
  defineTriangle(4);
  hlFlush();
  EXPECT_FALSE(server->frames()[1].has_gravity_m_s2());
  EXPECT_TRUE(server->received.back().has_frame()) << "asked for once";
}

TEST_F(CallsTest, EventsOfBodiesAreAskedForOnceWhereSomebodyListens) {
  std::vector<HLevent> heard;
  const auto note = [](const HLevent* event, void* user) {
    static_cast<std::vector<HLevent>*>(user)->push_back(*event);
  };
  hlEventFunc(HL_EVENT_SLEEP, nullptr, nullptr);
  EXPECT_TRUE(server->received.empty());
  hlEventFunc(HL_EVENT_IMPACT, note, &heard);
  hlEventFunc(HL_EVENT_WAKE, note, &heard);
  ASSERT_EQ(server->received.size(), 1U);
  EXPECT_TRUE(server->received[0].body_request().events());
  EXPECT_FALSE(server->received[0].body_request().wanted());
  defineTriangle(3);
  hlFlush();
  EXPECT_TRUE(server->received[1].body_request().events()) << "still";
  EXPECT_TRUE(server->received[1].body_request().wanted());
  for (const proto::EventKind kind : {proto::IMPACT, proto::SLEEP, proto::WAKE}) {
    proto::Event& event = *server->replies.emplace_back().mutable_event();
    event.set_kind(kind);
    event.set_object(3);
    event.set_impulse_n_s(kind == proto::IMPACT ? 0.25 : 0);
  }
  EXPECT_EQ(hlPoll(), 2);
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].kind, HL_EVENT_IMPACT);
  EXPECT_EQ(heard[0].impulse, 0.25);
  EXPECT_EQ(heard[1].kind, HL_EVENT_WAKE);
  EXPECT_EQ(heard[1].object, 3U);
}

TEST_F(CallsTest, AnObjectThatIsDefinedWithoutABodyIsNone) {
  defineTriangle(3);
  hlNewObject(3);
  hlBegin(HL_POINTS);
  hlVertex3d(0, 0, 0);
  hlEnd();
  hlEndObject();
  hlFlush();
  EXPECT_FALSE(server->frames()[0].objects(0).has_body());
}

TEST_F(CallsTest, WhatIsDoneToBodiesGoesAtOnceToThoseOfTheCurrentName) {
  defineTriangle(3);
  hlBodyImpulsed(3, 1, 2, 3, 4, 5, 6, 0.5);
  const proto::BodyCommand push = server->received.back().body_command();
  EXPECT_EQ(push.object(), 3U);
  EXPECT_FALSE(push.has_name());
  EXPECT_EQ(push.push().impulse_n_s().y(), 2);
  EXPECT_EQ(push.push().point().z(), 6);
  EXPECT_EQ(push.push().duration_s(), 0.5);
  hlLoadName(9);
  hlBodyVelocityd(3, 1, 2, 3, 4, 5, 6);
  EXPECT_EQ(server->received.back().body_command().name(), 9U);
  EXPECT_EQ(server->received.back().body_command().velocity().spin_rad_s().x(), 4);
  hlBodyPlaced(3, 1, 2, 3, 0, 0, 2, 0);
  EXPECT_EQ(server->received.back().body_command().place().position().x(), 1);
  EXPECT_EQ(server->received.back().body_command().place().rotation().z(), 1);
  expectCallError(HL_NO_ERROR);
}

TEST_F(CallsTest, BodiesOutOfRangeAreErrorsAndNotSent) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  hlBodyd(HL_BODY_MASS, 1), expectCallError(HL_INVALID_OPERATION);
  hlNewObject(1);
  hlBodyd(HL_BODY_MASS, 0), expectCallError(HL_INVALID_VALUE);
  hlBodyd(HL_BODY_DENSITY, kInfinite), expectCallError(HL_INVALID_VALUE);
  hlBodyd(HL_BODY_RESTITUTION, 1.01), expectCallError(HL_INVALID_VALUE);
  hlBodyd(HL_BODY_DYNAMIC_FRICTION, std::nan("")), expectCallError(HL_INVALID_VALUE);
  hlBodyd(HL_STIFFNESS, 1), expectCallError(HL_INVALID_ENUM);
  hlBodyi(HL_BODY_SHAPE, HL_POINTS), expectCallError(HL_INVALID_ENUM);
  hlBodyi(HL_BODY_MASS, 1), expectCallError(HL_INVALID_ENUM);
  hlBody3d(HL_BODY_VELOCITY, 101, 0, 0), expectCallError(HL_INVALID_VALUE);
  hlGravity3d(0, -9.81, 0), expectCallError(HL_INVALID_OPERATION);
  hlEndObject();
  hlGravity3d(0, 1001, 0), expectCallError(HL_INVALID_VALUE);
  hlBodyImpulsed(2, 0, 0, 0, 0, 0, 0, 0), expectCallError(HL_INVALID_VALUE);
  hlBodyImpulsed(1, 0, 0, 0, 0, 0, 0, 11), expectCallError(HL_INVALID_VALUE);
  hlBodyPlaced(1, 0, 0, 0, 0, 0, 0, 0), expectCallError(HL_INVALID_VALUE);
  hlGetBodies(-1, nullptr), expectCallError(HL_INVALID_VALUE);
  std::array<double, 16> values{};
  hlGetBodydv(1, HL_BODY_MASS, values.data()), expectCallError(HL_INVALID_ENUM);
  hlGetBodydv(1, HL_BODY_MATRIX, nullptr), expectCallError(HL_INVALID_VALUE);
  EXPECT_TRUE(server->received.empty());
}

TEST_F(CallsTest, TheStateGivesWhereBodiesAre) {
  proto::ClientState& state = server->sendState();
  for (const std::uint32_t name : {8U, 5U}) {
    proto::BodyState& body = *state.add_bodies();
    body.set_object(3);
    body.set_name(name);
    body.mutable_position()->set_x(name);
    body.mutable_rotation()->set_z(std::sqrt(0.5));  // a quarter turn about z
    body.mutable_rotation()->set_w(std::sqrt(0.5));
    body.mutable_velocity_m_s()->set_y(2);
  }
  hlPoll();
  EXPECT_EQ(number(HL_BODY_COUNT), 2);
  std::array<HLbody, 3> bodies{};
  ASSERT_EQ(hlGetBodies(3, bodies.data()), 2);
  EXPECT_EQ(bodies[0].name, 5U);
  EXPECT_EQ(bodies[1].position[0], 8);
  EXPECT_EQ(bodies[1].velocity[1], 2);
  std::array<double, 16> m{};
  EXPECT_EQ(hlGetBodydv(3, HL_BODY_MATRIX, m.data()), HL_TRUE);
  EXPECT_EQ(m[12], 5);
  EXPECT_NEAR(m[1], 1, 1e-15);   // x goes to y
  EXPECT_NEAR(m[4], -1, 1e-15);  // y goes to -x
  hlLoadName(8);
  EXPECT_EQ(hlGetBodydv(3, HL_BODY_POSITION, m.data()), HL_TRUE);
  EXPECT_EQ(m[0], 8);
  hlLoadName(7);
  EXPECT_EQ(hlGetBodydv(3, HL_BODY_POSITION, m.data()), HL_FALSE);
  expectCallError(HL_NO_ERROR);
}

}  // namespace
}  // namespace hl::client::test_bodies
