// Device settings, queries of the state, contacts and events.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "client/event_queue.h"
#include "client/fake_server.h"

namespace hl::client::test_device {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
void expectError(HLenum error) { EXPECT_EQ(hlGetError(), error); }

TEST_F(CallsTest, DeviceSettingsGoAtOnce) {
  hlProxyd(HL_PROXY_RADIUS, 2e-3);
  EXPECT_EQ(server->received.back().device().proxy_radius(), 2e-3);
  hlProxyf(HL_PROXY_RADIUS, 0.5F);
  EXPECT_EQ(server->received.back().device().proxy_radius(), 0.5);
  hlWorkspaced(1, 2, 3, 4);
  EXPECT_EQ(server->received.back().device().workspace().origin().z(), 3);
  EXPECT_EQ(server->received.back().device().workspace().world_per_device(), 4);
  EXPECT_FALSE(server->received.back().device().has_proxy_radius());
  hlLedger(HL_LEDGER_REPORT);
  EXPECT_EQ(server->received.back().device().ledger(), proto::REPORT);
  hlRearm();
  EXPECT_TRUE(server->received.back().device().rearm());
  hlHandGoal3d(0.1, 0.2, 0.3);
  EXPECT_EQ(server->received.back().device().hand_goal().position().y(), 0.2);
  EXPECT_EQ(number(HL_SPRING_STIFFNESS), 1000);
  hlSpringd(1500);
  EXPECT_EQ(server->received.back().device().stiffness_n_m(), 1500);
  EXPECT_EQ(number(HL_SPRING_STIFFNESS), 1500);
  hlHandGrip(HL_GRIP_FIRM);
  EXPECT_TRUE(server->received.back().device().hand_firm());
  hlHandGrip(HL_GRIP_LIGHT);
  EXPECT_TRUE(server->received.back().device().has_hand_firm());
  EXPECT_FALSE(server->received.back().device().hand_firm());
  hlStateRate(1000);
  EXPECT_EQ(server->received.back().state_rate().rate_hz(), 1000);
}

TEST_F(CallsTest, DeviceSettingsOutOfRangeAreErrorsAndNotSent) {
  hlProxyd(HL_STIFFNESS, 1), expectError(HL_INVALID_ENUM);
  hlProxyd(HL_PROXY_RADIUS, 0), expectError(HL_INVALID_VALUE);
  hlProxyf(HL_PROXY_RADIUS, -1), expectError(HL_INVALID_VALUE);
  hlProxyd(HL_PROXY_RADIUS, kNaN), expectError(HL_INVALID_VALUE);
  hlWorkspaced(0, 0, 0, 0), expectError(HL_INVALID_VALUE);
  hlWorkspaced(kNaN, 0, 0, 1), expectError(HL_INVALID_VALUE);
  hlSpringd(0), expectError(HL_INVALID_VALUE);
  hlLedger(HL_POINTS), expectError(HL_INVALID_ENUM);
  hlHandGoal3d(0, kNaN, 0), expectError(HL_INVALID_VALUE);
  hlHandGrip(HL_LEDGER_TANK), expectError(HL_INVALID_ENUM);
  hlHandTurn4d(0, 0, 0, 0), expectError(HL_INVALID_VALUE);
  hlHandTurn4d(0, kNaN, 0, 1), expectError(HL_INVALID_VALUE);
  hlHandGripperd(kNaN), expectError(HL_INVALID_VALUE);
  hlKeepSamples(-1), expectError(HL_INVALID_VALUE);
  hlTakeSamples(-1, nullptr), expectError(HL_INVALID_VALUE);
  hlStateRate(-1), expectError(HL_INVALID_VALUE);
  hlStateRate(1001), expectError(HL_INVALID_VALUE);
  EXPECT_TRUE(server->received.empty());
}

void addSample(proto::ClientState& state, double time_s) {
  proto::DeviceSample& sample = *state.add_samples();
  sample.set_time_s(time_s);
  sample.mutable_finger()->set_x(10 * time_s);
  sample.mutable_force_n()->set_y(20 * time_s);
  sample.set_buttons(2);
  if (time_s < 4) return;
  sample.mutable_stylus()->mutable_rotation()->set_y(1);
  sample.mutable_stylus()->mutable_spin_rad_s()->set_z(3);
  sample.mutable_stylus()->set_gripper_rad(0.25);
  sample.mutable_stylus()->set_gripper_n(1.5);
}

TEST_F(CallsTest, SamplesAreKeptUntilTheyAreTakenTheNewestOnes) {
  HLsample taken[4];
  addSample(server->sendState(), 1);
  hlPoll();
  EXPECT_EQ(hlTakeSamples(4, taken), 0) << "nobody has asked";
  hlKeepSamples(3);
  EXPECT_TRUE(server->received.back().sample_request().wanted());
  proto::ClientState& first = server->sendState();
  addSample(first, 1);
  addSample(first, 2);
  hlPoll();
  addSample(server->sendState(), 3);
  addSample(server->sendState(), 4);
  hlPoll();
  ASSERT_EQ(hlTakeSamples(2, taken), 2);
  EXPECT_EQ(taken[0].time, 2);
  EXPECT_EQ(taken[0].position[0], 20);
  EXPECT_EQ(taken[0].force[1], 40);
  EXPECT_EQ(taken[0].buttons, 2U);
  EXPECT_EQ(taken[0].rotation[3], 1) << "without a wrist it is not turned";
  EXPECT_EQ(taken[1].time, 3);
  ASSERT_EQ(hlTakeSamples(4, taken), 1);
  EXPECT_EQ(taken[0].time, 4);
  EXPECT_EQ(taken[0].rotation[1], 1);
  EXPECT_EQ(taken[0].rotation[3], 0);
  EXPECT_EQ(taken[0].spin[2], 3);
  EXPECT_EQ(taken[0].gripper, 0.25);
  EXPECT_EQ(taken[0].grip_force, 1.5);
  hlKeepSamples(0);
  EXPECT_FALSE(server->received.back().sample_request().wanted());
  addSample(server->sendState(), 5);
  hlPoll();
  EXPECT_EQ(hlTakeSamples(4, taken), 0);
}

proto::ContactReport& sendReport(FakeServer& server, double time_s, double interval_s, double force_N) {
  proto::ContactReport& report = *server.replies.emplace_back().mutable_contact_report();
  report.set_time_s(time_s);
  report.set_interval_s(interval_s);
  report.mutable_force_n()->set_y(force_N);
  return report;
}

void addPoint(proto::ContactReport& report, HLuint session, HLuint object, const std::array<double, 3>& weights,
              double force_N) {
  proto::PressedPoint& point = *report.add_contacts();
  point.set_session(session);
  point.set_object(object);
  point.mutable_force_n()->set_y(force_N);
  for (HLuint i = 0; i < 3; ++i) {
    point.add_vertices(4 + i);
    point.add_weights(weights[i]);
  }
}

// Reports that come between two calls are one: their impulses add up.
TEST_F(CallsTest, ContactReportsAreMeansSinceTheLastOneThatWasTaken) {
  HLcontactforce contacts[4];
  HLcontactreport report;
  addPoint(sendReport(*server, 1, 0.02, 1), 7, 3, {1, 0, 0}, 1);
  hlPoll();
  EXPECT_EQ(hlTakeContactReport(4, contacts, &report), 0) << "nobody has asked";
  EXPECT_EQ(report.interval, 0);
  hlKeepContactReport(HL_TRUE);
  EXPECT_TRUE(server->received.back().contact_report_request().wanted());
  addPoint(sendReport(*server, 2, 0.01, 1), 7, 3, {1, 0, 0}, 1);
  proto::ContactReport& second = sendReport(*server, 3, 0.03, 3);
  addPoint(second, 7, 3, {0, 1, 0}, 2);
  addPoint(second, 8, 3, {0, 1, 0}, 1);
  hlPoll();
  ASSERT_EQ(hlTakeContactReport(4, contacts, &report), 2);
  EXPECT_EQ(report.time, 3);
  EXPECT_NEAR(report.interval, 0.04, 1e-15);
  EXPECT_NEAR(report.force[1], 2.5, 1e-12);
  EXPECT_EQ(contacts[0].object, 3U);
  EXPECT_EQ(contacts[0].session, 7U);
  EXPECT_EQ(contacts[0].vertex_count, 3U);
  EXPECT_EQ(contacts[0].vertices[2], 6U);
  EXPECT_NEAR(contacts[0].force[1], 1.75, 1e-12);
  EXPECT_NEAR(contacts[0].weights[0], 1. / 7, 1e-12);
  EXPECT_NEAR(contacts[1].force[1], 0.75, 1e-12);
  EXPECT_EQ(hlTakeContactReport(4, contacts, nullptr), 0) << "it is forgotten";
  hlTakeContactReport(-1, contacts, nullptr), expectError(HL_INVALID_VALUE);
  hlTakeContactReport(1, nullptr, nullptr), expectError(HL_INVALID_VALUE);
  hlKeepContactReport(HL_FALSE);
  EXPECT_FALSE(server->received.back().contact_report_request().wanted());
}

TEST_F(CallsTest, AComplianceGoesWithTheFrame) {
  hlNewObject(3);
  hlBegin(HL_POINTS);
  hlVertex3d(0, 0, 0);
  hlEnd();
  hlEndObject();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double force[3] = {1, 2, 3}, bad[3] = {0, nan, 0};
  hlCompliance(4, 1, 1, force), expectError(HL_INVALID_VALUE);
  hlCompliance(3, -1, 1, force), expectError(HL_INVALID_VALUE);
  hlCompliance(3, 1, nan, force), expectError(HL_INVALID_VALUE);
  hlCompliance(3, 1e10, 1, force), expectError(HL_INVALID_VALUE);
  hlCompliance(3, 1, 1, bad), expectError(HL_INVALID_VALUE);
  hlCompliance(3, 0.01, 0.02, force);
  hlFlush();
  const proto::Frame& frame = server->received.back().frame();
  ASSERT_EQ(frame.compliances_size(), 1);
  EXPECT_EQ(frame.compliances(0).object(), 3U);
  EXPECT_EQ(frame.compliances(0).normal_m_n(), 0.01);
  EXPECT_EQ(frame.compliances(0).tangential_m_n(), 0.02);
  EXPECT_EQ(frame.compliances(0).computed_for_n().z(), 3);
}

// NULL: the forces on this context's object in the report that was taken last.
TEST_F(CallsTest, AComplianceWithoutAForceIsForTheLastReport) {
  hlNewObject(3);
  hlEndObject();
  hlKeepContactReport(HL_TRUE);
  proto::ContactReport& report = sendReport(*server, 1, 0.02, 6);
  addPoint(report, 7, 3, {1, 0, 0}, 1);
  addPoint(report, 7, 3, {0, 1, 0}, 2);
  addPoint(report, 8, 3, {0, 0, 1}, 3);
  hlPoll();
  hlTakeContactReport(0, nullptr, nullptr);
  hlCompliance(3, 0.01, 0.01, nullptr);
  hlFlush();
  EXPECT_NEAR(server->received.back().frame().compliances(0).computed_for_n().y(), 3, 1e-12);
}

TEST_F(CallsTest, CountsOfTicksAndTheGripAreQueries) {
  EXPECT_EQ(integer(HL_HAND_GRIP), HL_GRIP_LIGHT);
  proto::ClientState& state = server->sendState();
  state.set_iteration_caps(3);
  state.set_unplaced_ticks(4);
  state.mutable_ticks_ended()->set_out_of_work(5);
  state.set_hand_firm(true);
  hlPoll();
  EXPECT_EQ(integer(HL_ITERATION_CAPS), 3);
  EXPECT_EQ(integer(HL_UNPLACED_TICKS), 4);
  EXPECT_EQ(integer(HL_OUT_OF_WORK_TICKS), 5);
  EXPECT_EQ(integer(HL_HAND_GRIP), HL_GRIP_FIRM);
}

TEST_F(CallsTest, OnlyTheMasterSetsTheDevice) {
  server->sendState().set_master(false);
  hlPoll();
  EXPECT_EQ(integer(HL_MASTER), HL_FALSE);
  hlProxyd(HL_PROXY_RADIUS, 1), expectError(HL_INVALID_OPERATION);
  hlRearm(), expectError(HL_INVALID_OPERATION);
  hlStateRate(30);  // everybody's own
  EXPECT_EQ(server->received.size(), 1U);
  server->sendState().set_master(true);
  hlPoll();
  hlRearm();
}

TEST_F(CallsTest, BeforeTheFirstStateEverythingIsZeroAndInfinitelyOld) {
  EXPECT_EQ(number(HL_FINGER_POSITION), 0);
  EXPECT_EQ(integer(HL_SAFETY_STATE), HL_SAFETY_OFF);
  EXPECT_EQ(integer(HL_CONTACT_COUNT), 0);
  EXPECT_EQ(number(HL_STATE_AGE), std::numeric_limits<double>::infinity());
  EXPECT_EQ(integer(HL_SESSION), 7);
}

TEST_F(CallsTest, TheStylusIsAskedForAndTurned) {
  HLdouble turned[4];
  hlGetDoublev(HL_STYLUS_ROTATION, turned);
  EXPECT_EQ(turned[3], 1) << "before the first state it is not turned";
  proto::ClientState& state = server->sendState();
  state.set_master(true);
  proto::Stylus& stylus = *state.mutable_stylus();
  stylus.mutable_rotation()->set_x(0.6);
  stylus.mutable_rotation()->set_w(0.8);
  stylus.mutable_spin_rad_s()->set_y(-2);
  stylus.set_gripper_rad(0.3);
  stylus.set_gripper_n(4);
  hlPoll();
  hlGetDoublev(HL_STYLUS_ROTATION, turned);
  EXPECT_EQ(turned[0], 0.6);
  EXPECT_EQ(turned[3], 0.8);
  HLdouble spin[3];
  hlGetDoublev(HL_STYLUS_SPIN, spin);
  EXPECT_EQ(spin[1], -2);
  EXPECT_EQ(number(HL_GRIPPER_ANGLE), 0.3);
  EXPECT_EQ(number(HL_GRIPPER_FORCE), 4);
  hlHandTurn4d(1, 2, 3, 4);
  EXPECT_EQ(server->received.back().device().hand_turn().rotation().z(), 3);
  EXPECT_EQ(server->received.back().device().hand_turn().rotation().w(), 4);
  EXPECT_FALSE(server->received.back().device().hand_turn().has_gripper_rad());
  hlHandGripperd(0.125);
  EXPECT_EQ(server->received.back().device().hand_turn().gripper_rad(), 0.125);
}

proto::TouchedObject& touch(proto::ClientState& state, HLuint object, HLuint session, double share) {
  proto::TouchedObject& touched = *state.add_touched();
  touched.set_object(object);
  touched.set_name(10 * object);
  touched.set_session(session);
  touched.mutable_plane()->set_multiplier_m(share);
  touched.mutable_plane()->mutable_normal()->set_z(1);
  touched.mutable_plane()->mutable_point()->set_x(object);
  return touched;
}

TEST_F(CallsTest, QueriesAnswerFromTheLastStateTaken) {
  proto::ClientState& state = server->sendState();
  state.mutable_finger()->set_y(2);
  state.mutable_force_n()->set_z(3);
  state.set_safety(proto::FAULT);
  state.set_fault("too fast");
  state.set_buttons(5);
  state.mutable_servo()->set_rate_hz(1000);
  state.mutable_proxy_loop()->set_deadlines_missed(4);
  state.mutable_ledger()->set_mode(proto::STRICT);
  state.mutable_ledger()->set_injected_j(0.25);
  state.mutable_vibration()->set_alarms(3);
  state.mutable_vibration()->set_limit_n_m(420);
  state.set_proxy_radius(1e-3);
  state.set_time_s(12);
  EXPECT_EQ(number(HL_STATE_TIME), 0);
  hlPoll();
  HLdouble position[3];
  hlGetDoublev(HL_FINGER_POSITION, position);
  EXPECT_EQ(position[1], 2);
  hlGetDoublev(HL_FORCE, position);
  EXPECT_EQ(position[2], 3);
  EXPECT_EQ(integer(HL_SAFETY_STATE), HL_SAFETY_FAULT);
  EXPECT_STREQ(hlGetString(HL_FAULT), "too fast");
  EXPECT_EQ(integer(HL_BUTTONS), 5);
  EXPECT_EQ(number(HL_SERVO_RATE), 1000);
  EXPECT_EQ(integer(HL_PROXY_DEADLINES_MISSED), 4);
  EXPECT_EQ(integer(HL_LEDGER_MODE), HL_LEDGER_STRICT);
  EXPECT_EQ(number(HL_LEDGER_INJECTED), 0.25);
  EXPECT_EQ(integer(HL_VIBRATIONS), 3);
  EXPECT_EQ(number(HL_SPRING_LIMIT), 420);
  EXPECT_EQ(number(HL_PROXY_RADIUS), 1e-3);
  EXPECT_EQ(number(HL_STATE_TIME), 12);
  EXPECT_GE(number(HL_STATE_AGE), 0);
  EXPECT_LT(number(HL_STATE_AGE), 1e6);
}

TEST_F(CallsTest, ContactsComeHardestFirstAndTouchedIsOurs) {
  proto::ClientState& state = server->sendState();
  touch(state, 1, 7, 1e-3);
  touch(state, 2, 8, 5e-3);  // another session's
  touch(state, 3, 7, 2e-3);
  hlPoll();
  EXPECT_EQ(integer(HL_CONTACT_COUNT), 3);
  EXPECT_EQ(integer(HL_TOUCHED_OBJECT), 3);
  EXPECT_EQ(integer(HL_TOUCHED_NAME), 30);
  HLcontact contacts[5];
  ASSERT_EQ(hlGetContacts(5, contacts), 3);
  EXPECT_EQ(contacts[0].object, 2U);
  EXPECT_EQ(contacts[0].session, 8U);
  EXPECT_EQ(contacts[1].object, 3U);
  EXPECT_EQ(contacts[1].share, 2e-3);
  EXPECT_EQ(contacts[1].normal[2], 1);
  EXPECT_EQ(contacts[1].point[0], 3);
  EXPECT_EQ(hlGetContacts(1, contacts), 1);
  EXPECT_EQ(hlGetContacts(0, nullptr), 0);
  hlGetContacts(-1, contacts), expectError(HL_INVALID_VALUE);
}

TEST_F(CallsTest, EveryQueryOfTheHeaderIsAnswered) {
  std::vector<HLenum> names{HL_PROXY_RADIUS};
  for (HLenum name = HL_STIFFNESS; name <= HL_PRESLIDING; ++name) names.push_back(name);
  for (HLenum name = HL_SESSION; name <= HL_FRAME_PRIMITIVES; ++name) names.push_back(name);
  for (HLenum name = HL_MAX_OBJECTS; name <= HL_SPRING_DAMPING; ++name) names.push_back(name);
  for (HLenum name = HL_FINGER_POSITION; name <= HL_SPRING_LIMIT; ++name) names.push_back(name);
  for (const HLenum name : {HL_CURRENT_NORMAL,
                            HL_CURRENT_TEXTURE_COORDS,
                            HL_CURRENT_NAME,
                            HL_CURRENT_OBJECT,
                            HL_SHADE_MODEL,
                            HL_MATRIX_MODE,
                            HL_MODELVIEW_STACK_DEPTH,
                            HL_TEXTURE_STACK_DEPTH,
                            HL_MODELVIEW_MATRIX,
                            HL_TEXTURE_MATRIX,
                            HL_ATTRIB_STACK_DEPTH,
                            HL_NAME_STACK_DEPTH,
                            HL_ACTIVE_TEXTURE,
                            HL_TEXTURE_BINDING_2D,
                            HL_MAX_TEXTURE_SIZE,
                            HL_MAX_TEXTURE_UNITS,
                            HL_MAX_ATTRIB_STACK_DEPTH,
                            HL_MAX_MODELVIEW_STACK_DEPTH,
                            HL_MAX_NAME_STACK_DEPTH,
                            HL_MAX_TEXTURE_STACK_DEPTH})
    names.push_back(name);
  for (const HLenum name : names) {
    number(name);
    EXPECT_EQ(hlGetError(), HL_NO_ERROR) << "query " << name;
  }
}

// ---- Events ----

struct Heard {
  std::vector<HLevent> events;
  static void note(const HLevent* event, void* user) { static_cast<Heard*>(user)->events.push_back(*event); }
};

proto::Event& happen(FakeServer& server, proto::EventKind kind, HLuint object = 0) {
  proto::Event& event = *server.replies.emplace_back().mutable_event();
  event.set_kind(kind);
  event.set_object(object);
  return event;
}

TEST_F(CallsTest, EventsAreDeliveredOnlyByPoll) {
  Heard heard;
  for (HLenum kind = HL_EVENT_TOUCH; kind <= HL_EVENT_MOTION; ++kind) hlEventFunc(kind, Heard::note, &heard);
  proto::Event& touched = happen(*server, proto::TOUCH, 3);
  touched.set_name(4);
  touched.set_time_s(5);
  touched.mutable_position()->set_x(6);
  proto::Event& button = happen(*server, proto::BUTTON);
  button.set_button(1);
  button.set_down(true);
  hlFlush();
  EXPECT_TRUE(heard.events.empty());
  EXPECT_EQ(hlPoll(), 2);
  ASSERT_EQ(heard.events.size(), 2U);
  EXPECT_EQ(heard.events[0].kind, HL_EVENT_TOUCH);
  EXPECT_EQ(heard.events[0].object, 3U);
  EXPECT_EQ(heard.events[0].name, 4U);
  EXPECT_EQ(heard.events[0].time, 5);
  EXPECT_EQ(heard.events[0].position[0], 6);
  EXPECT_EQ(heard.events[1].kind, HL_EVENT_BUTTON);
  EXPECT_EQ(heard.events[1].button, 1U);
  EXPECT_EQ(heard.events[1].down, HL_TRUE);
  EXPECT_EQ(hlPoll(), 0);
}

TEST_F(CallsTest, KindsWithoutACallbackAreDropped) {
  Heard heard;
  hlEventFunc(HL_EVENT_TOUCH, Heard::note, &heard);
  happen(*server, proto::MOTION);
  happen(*server, proto::TOUCH, 1);
  EXPECT_EQ(hlPoll(), 1);
  hlEventFunc(HL_EVENT_TOUCH, nullptr, nullptr);
  happen(*server, proto::TOUCH, 1);
  EXPECT_EQ(hlPoll(), 0);
  hlEventFunc(HL_PROXY_RADIUS, Heard::note, &heard), expectError(HL_INVALID_ENUM);
}

TEST_F(CallsTest, AMotionIsAnEventWhenTheHandHasGoneAMillimetre) {
  const auto fingerAt = [&](double x) {
    proto::ClientState& state = *server->replies.emplace_back().mutable_state();
    state.set_time_s(x);
    state.mutable_finger()->set_x(x);
    state.mutable_proxy()->set_x(x + 1);
    state.mutable_workspace()->set_world_per_device(10);
  };
  Heard heard;
  fingerAt(0);
  EXPECT_EQ(hlPoll(), 0);
  hlEventFunc(HL_EVENT_MOTION, Heard::note, &heard);
  for (const double x : {1.0, 1.004, 1.008, 1.012, 1.02, 1.023}) fingerAt(x);
  EXPECT_EQ(hlPoll(), 2);
  ASSERT_EQ(heard.events.size(), 2U);
  EXPECT_EQ(heard.events[0].kind, HL_EVENT_MOTION);
  EXPECT_EQ(heard.events[0].time, 1.012);
  EXPECT_EQ(heard.events[0].position[0], 2.012);
  EXPECT_EQ(heard.events[1].time, 1.023);
}

TEST_F(CallsTest, OfEventsThatNobodyPollsTheLastAreKept) {
  Heard heard;
  hlEventFunc(HL_EVENT_TOUCH, Heard::note, &heard);
  for (HLuint i = 1; i <= kMaxEvents + 3; ++i) happen(*server, proto::TOUCH, i);
  EXPECT_EQ(hlPoll(), static_cast<HLint>(kMaxEvents));
  EXPECT_EQ(heard.events[0].object, 4U);
}

TEST_F(CallsTest, CallbacksMayDrawButNeitherPollNorDestroy) {
  hlEventFunc(
      HL_EVENT_TOUCH,
      [](const HLevent*, void*) {
        triangle();
        hlFlush();
        EXPECT_EQ(hlGetError(), HL_NO_ERROR);
        EXPECT_EQ(hlPoll(), 0);
        EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
        hlDestroyContext(hlGetCurrentContext());
        EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
      },
      nullptr);
  happen(*server, proto::TOUCH, 1);
  EXPECT_EQ(hlPoll(), 1);
  EXPECT_EQ(server->frames().size(), 1U);
}

TEST_F(CallsTest, CallbackThatThrowsIsAnErrorAndTheOthersFollow) {
  int calls = 0;
  hlEventFunc(
      HL_EVENT_TOUCH,
      [](const HLevent*, void* user) {
        if (++*static_cast<int*>(user) == 1) throw std::runtime_error("clumsy");
      },
      &calls);
  happen(*server, proto::TOUCH, 1);
  happen(*server, proto::TOUCH, 2);
  EXPECT_EQ(hlPoll(), 0);
  EXPECT_STREQ(hlGetString(HL_ERROR_STRING), "hlPoll: clumsy");
  expectError(HL_INVALID_OPERATION);
  EXPECT_EQ(hlPoll(), 1);
}

}  // namespace
}  // namespace hl::client::test_device
