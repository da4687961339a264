// The hand's side of a teleoperation, and the header that both sides count with: closed forms.
#include "control/remote_port.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "guard/realtime_guard.h"

namespace hl::test_remote_port {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kStep_ns = 1'000'000;

TEST(TeleopPort, WhatIsPutInFillsTheTankAndTheRestGoesToTheOtherSide) {
  HLteleopPort port = hlTeleopPort();
  hlTeleopBook(&port, 0.004);
  EXPECT_NEAR(port.tank_J, 0.006, 1e-15);
  hlTeleopBook(&port, -0.010);
  EXPECT_NEAR(port.tank_J, 0.010, 1e-15);
  EXPECT_NEAR(port.sent_J, 0.006, 1e-15);
  EXPECT_NEAR(port.given_J, 0.004, 1e-15);
  EXPECT_NEAR(port.put_in_J, 0.010, 1e-15);
}

TEST(TeleopPort, AnOlderTotalOrNoneChangesNothing) {
  HLteleopPort port = hlTeleopPort();
  hlTeleopReceive(&port, 0.02);
  for (const double total_J : std::initializer_list<double>{0.02, 0.01, -1.0, kNone, HUGE_VAL})
    hlTeleopReceive(&port, total_J);
  hlTeleopBook(&port, kNone);
  EXPECT_NEAR(port.tank_J, 0.03, 1e-15);
  EXPECT_EQ(port.received_J, 0.02);
  hlTeleopReceiveAnew(&port, 0.001);
  hlTeleopReceive(&port, 0.003);
  EXPECT_NEAR(port.tank_J, 0.032, 1e-15);
}

// Whatever is booked and however it is sent, the two sides have given no more than was put in, and their tanks.
RC_GTEST_PROP(TeleopPort, TwoSidesGiveNoMoreThanTheyWereGiven, ()) {
  HLteleopPort left = hlTeleopPort(), right = hlTeleopPort();
  for (const int milli_J : *rc::gen::container<std::vector<int>>(rc::gen::inRange(-20, 21))) {
    HLteleopPort& here = milli_J % 2 == 0 ? left : right;
    HLteleopPort& there = milli_J % 2 == 0 ? right : left;
    hlTeleopBook(&here, std::min(1e-3 * milli_J, std::max(0.0, here.tank_J)));
    if (milli_J % 3 != 0) hlTeleopReceive(&there, here.sent_J);
    const double net_J = left.put_in_J + right.put_in_J - left.given_J - right.given_J;
    RC_ASSERT(net_J >= -2 * HL_TELEOP_TANK_J - 1e-12);
    RC_ASSERT(left.tank_J >= -1e-12);
    RC_ASSERT(right.tank_J >= -1e-12);
  }
}

TEST(TeleopRobot, BeginsWhereItIsAndNeverJumps) {
  const double place_m[3] = {0.1, 0.2, 0.3}, force_N[3] = {0, 0, 0};
  HLteleopRobot robot = hlTeleopRobot(place_m, 0.1);
  const double far_m[3] = {5, 5, 5}, further_m[3] = {5, 6, 5};
  hlTeleopSetPoint(&robot, far_m, 0);
  hlTeleopStep(&robot, force_N, 1e-3);
  EXPECT_EQ(robot.reference_m[1], 0.2);
  hlTeleopSetPoint(&robot, further_m, 0);
  const double bad_m[3] = {0, kNone, 0};
  hlTeleopSetPoint(&robot, bad_m, 0);
  for (int i = 0; i < 1000; ++i) hlTeleopStep(&robot, force_N, 1e-3);
  EXPECT_NEAR(robot.reference_m[1], 0.3, 1e-9);  // 0.1 m/s
  hlTeleopSetPoint(&robot, place_m, 1);
  EXPECT_NEAR(robot.goal_m[1], 0.3, 1e-9);
}

// A spring of 1000 N/m gets 1/2 K x^2 = 8 milli_J and no more: 4 mm. Across the force the way is free.
TEST(TeleopRobot, PressesAsDeepAsItsTankPaysForAndSlidesFreely) {
  const double place_m[3] = {0, 0, 0}, goal_m[3] = {0.05, -0.05, 0};
  HLteleopRobot robot = hlTeleopRobot(place_m, 0.2);
  hlTeleopSetPoint(&robot, place_m, 0);
  hlTeleopSetPoint(&robot, goal_m, 0);
  for (int i = 0; i < 2000; ++i) {
    const double force_N[3] = {0, -1000 * std::min(0.0, robot.reference_m[1]), 0};
    hlTeleopStep(&robot, force_N, 1e-3);
  }
  EXPECT_NEAR(robot.reference_m[1], -0.004, 2e-5);
  EXPECT_NEAR(robot.reference_m[0], 0.05, 1e-4);
  EXPECT_GE(robot.port.tank_J, HL_TELEOP_RESERVE_J - 1e-4);
}

RemoteInput pushing(double force_N) {
  RemoteInput input;
  input.on = input.engaged = true;
  input.fresh_until_ns = 1'000'000'000;
  input.force_N = Vec3(0, force_N, 0);
  return input;
}

/// A hand that stands still, or goes on at a speed, for some steps.
struct Stepper {
  RemotePort port;
  RemoteStep step{0, 1e-3, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

  Vec3 go(const RemoteInput& input, double speed_m_s = 0) {
    step.way = Vec3(0, 1e-3 * speed_m_s, 0);
    return goOn(input, speed_m_s);
  }
  /// By the way of `step`.
  Vec3 goOn(const RemoteInput& input, double speed_m_s = 0) {
    step.now_ns += kStep_ns;
    step.velocity_m_s = Vec3(0, speed_m_s, 0);
    return port.held_N = remoteForce(port, input, step);
  }
};

TEST(RemotePort, RisesIn200MillisecondsAndIsGone25AfterItsDeadline) {
  Stepper hand;
  RemoteInput input = pushing(3);
  EXPECT_NEAR(hand.go(input).y(), 3 * 1e-3 / kRemoteRise_s, 1e-12);
  for (int i = 0; i < 200; ++i) hand.go(input);
  EXPECT_NEAR(hand.go(input).y(), 3, 1e-12);
  input.fresh_until_ns = hand.step.now_ns;
  for (int i = 0; i < 26; ++i) hand.go(input);
  EXPECT_EQ(hand.port.held_N, Vec3(Vec3::Zero()));
}

TEST(RemotePort, TheClutchLetsGoInTheSameTime) {
  Stepper hand;
  RemoteInput input = pushing(3);
  for (int i = 0; i < 300; ++i) hand.go(input);
  input.engaged = false;
  for (int i = 0; i < 26; ++i) hand.go(input);
  EXPECT_EQ(hand.port.held_N, Vec3(Vec3::Zero()));
}

// 3 N along 0.1 m/s are 0.3 milli_J a step: the tank's 10 milli_J are gone soon, and what is given is never more.
TEST(RemotePort, AHandThatGivesWayGetsTheTankAndNoMore) {
  Stepper hand;
  const RemoteInput input = pushing(3);
  for (int i = 0; i < 300; ++i) hand.go(input);
  for (int i = 0; i < 500; ++i) {
    hand.go(input, 0.1);
    ASSERT_GE(hand.port.energy.tank_J, 0);
  }
  EXPECT_LE(hand.port.energy.given_J, HL_TELEOP_TANK_J);
  EXPECT_GT(hand.port.energy.given_J, 0.5 * HL_TELEOP_TANK_J);
  EXPECT_GT(hand.port.withheld_J, 0.1);
}

TEST(RemotePort, AHandThatPushesAgainstItFeelsItWhole) {
  Stepper hand;
  const RemoteInput input = pushing(3);
  for (int i = 0; i < 300; ++i) hand.go(input);
  for (int i = 0; i < 500; ++i) hand.go(input, -0.1);
  EXPECT_NEAR(hand.port.held_N.y(), 3, 1e-9);
  EXPECT_NEAR(hand.port.energy.sent_J, 3 * 0.1 * 0.5, 1e-3);
}

// Two counts of an encoder to and fro, for a minute.
TEST(RemotePort, EncoderStepsAddUpToNothing) {
  Stepper hand;
  const RemoteInput input = pushing(3);
  RemoteInput fresh = input;
  for (int i = 0; i < 300; ++i) hand.go(input);
  for (int i = 0; i < 60'000; ++i) {
    fresh.fresh_until_ns = hand.step.now_ns + 2 * kStep_ns;
    hand.step.way.y() = i % 2 == 0 ? 60e-6 : -60e-6;
    hand.goOn(fresh);
  }
  EXPECT_NEAR(hand.port.held_N.y(), 3, 0.05);
  EXPECT_LT(hand.port.energy.sent_J, 1e-3);
}

TEST(RemotePort, AWallThatTheSceneHasTooIsFeltOnce) {
  Stepper hand;
  const RemoteInput input = pushing(3);
  for (int i = 0; i < 300; ++i) hand.go(input);
  hand.step.local_N = Vec3(1, 2, 0);
  EXPECT_NEAR(hand.go(input).y(), 1, 1e-12);
  hand.step.local_N = Vec3(0, 5, 0);
  EXPECT_EQ(hand.go(input).y(), 0);
  hand.step.local_N = Vec3(0, -5, 0);
  EXPECT_NEAR(hand.go(input).y(), 3, 1e-12);
}

TEST(RemotePort, WhatIsNoNumberIsNoForce) {
  Stepper hand;
  RemoteInput input = pushing(3);
  for (int i = 0; i < 300; ++i) hand.go(input);
  input.force_N.x() = kNone;
  input.given_up_J = kNone;
  EXPECT_EQ(hand.go(input), Vec3(Vec3::Zero()));
  EXPECT_EQ(hand.port.energy.tank_J, HL_TELEOP_TANK_J);
}

TEST(RemotePort, NeedsNoMemoryAndNoLocks) {
  Stepper hand;
  const RemoteInput input = pushing(3);
  const RealtimeGuard guard;
  hand.go(input, 0.1);
}

}  // namespace
}  // namespace hl::test_remote_port
