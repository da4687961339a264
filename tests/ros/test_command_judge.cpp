// What of ROS 2's commands a hand is to feel: bounded, for 50 ms, and nothing that is no number.
#include "ros/command_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "device/device_models.h"

namespace hl::test_command_judge {
namespace {

constexpr std::int64_t kNow_ns = 9'000'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

DeviceInfo device() { return premium10().info; }

HandCommand commandOf(RosInput input, const std::array<double, 3>& value, std::int64_t age_ns = 0) {
  HandCommand command;
  command.input = input;
  command.own_frame = 1;
  command.age_ns = age_ns;
  command.arrived_ns = kNow_ns;
  command.value = value;
  return command;
}

TEST(CommandJudge, AForceCountsForFiftyMilliseconds) {
  CommandJudge judge(device());
  EXPECT_EQ(judge.judge(commandOf(RosInput::kServoCf, {1, -2, 0.5}), kNow_ns), CommandVerdict::kTaken);
  EXPECT_LT((judge.pull().force_N - Vec3(1, -2, 0.5)).norm(), 1e-12);
  EXPECT_EQ(judge.pull().force_until_ns, kNow_ns + 50'000'000);
  EXPECT_EQ(judge.pull().spring_until_ns, 0);
}

TEST(CommandJudge, ASetPointIsASpringWithADamper) {
  CommandJudge judge(device());
  EXPECT_EQ(judge.judge(commandOf(RosInput::kServoCp, {0.01, -0.02, 0.005}), kNow_ns), CommandVerdict::kTaken);
  EXPECT_EQ(judge.pull().place_D, Vec3(0.01, -0.02, 0.005));
  EXPECT_EQ(judge.pull().spring_N_m, kSetPointSpring_N_m);
  EXPECT_EQ(judge.pull().damping_Ns_m, device().damping_Ns_m);
  EXPECT_EQ(judge.pull().spring_until_ns, kNow_ns + 50'000'000);
  EXPECT_EQ(judge.pull().force_until_ns, 0);
}

TEST(CommandJudge, OneTopicLeavesTheOtherAlone) {
  CommandJudge judge(device());
  judge.judge(commandOf(RosInput::kServoCf, {1, 0, 0}), kNow_ns);
  HandCommand later = commandOf(RosInput::kServoCp, {0, 0, 0});
  later.arrived_ns = kNow_ns + 10'000'000;
  judge.judge(later, later.arrived_ns);
  EXPECT_EQ(judge.pull().force_until_ns, kNow_ns + 50'000'000);
  EXPECT_EQ(judge.pull().spring_until_ns, kNow_ns + 60'000'000);
}

TEST(CommandJudge, WhatItWasOnItsWayItCountsLess) {
  CommandJudge judge(device());
  HandCommand command = commandOf(RosInput::kServoCf, {1, 0, 0}, 20'000'000);
  EXPECT_EQ(judge.judge(command, kNow_ns + 10'000'000), CommandVerdict::kTaken);
  EXPECT_EQ(judge.pull().force_until_ns, kNow_ns + 30'000'000);
  command.age_ns = 39'999'999;
  EXPECT_EQ(judge.judge(command, kNow_ns + 10'000'000), CommandVerdict::kTaken);
  command.age_ns = 40'000'000;
  EXPECT_EQ(judge.judge(command, kNow_ns + 10'000'000), CommandVerdict::kStale);
}

// No time of a broken clock makes it count for longer, nor does its arithmetic overflow.
TEST(CommandJudge, NoClockMakesACommandCountLonger) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max(),
                         kMin = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t age_ns : {kMin, std::int64_t{-1}, std::int64_t{0}, kMax}) {
    for (const std::int64_t arrived_ns : {kMin, std::int64_t{0}, kNow_ns, kNow_ns + 1, kMax}) {
      CommandJudge judge(device());
      HandCommand command = commandOf(RosInput::kServoCf, {1, 0, 0}, age_ns);
      command.arrived_ns = arrived_ns;
      const CommandVerdict verdict = judge.judge(command, kNow_ns);
      EXPECT_EQ(verdict, arrived_ns == kNow_ns && age_ns <= 0 ? CommandVerdict::kTaken : CommandVerdict::kStale);
      EXPECT_LE(judge.pull().force_until_ns, kNow_ns + kCommandLife_ns);
    }
  }
}

TEST(CommandJudge, WhatIsNoNumberChangesNothing) {
  CommandJudge judge(device());
  judge.judge(commandOf(RosInput::kServoCf, {1, 0, 0}), kNow_ns);
  for (const double bad : {kNan, kInf, -kInf}) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (const RosInput input : {RosInput::kServoCf, RosInput::kServoCp}) {
        HandCommand command = commandOf(input, {2, 2, 2});
        command.value[i] = bad;
        EXPECT_EQ(judge.judge(command, kNow_ns), CommandVerdict::kNotANumber);
      }
    }
  }
  EXPECT_EQ(judge.pull().force_N, Vec3(1, 0, 0));
  EXPECT_EQ(judge.pull().spring_until_ns, 0);
}

TEST(CommandJudge, AnotherFrameAndAnotherInputAreRefused) {
  CommandJudge judge(device());
  HandCommand command = commandOf(RosInput::kServoCf, {1, 0, 0});
  command.own_frame = 0;
  EXPECT_EQ(judge.judge(command, kNow_ns), CommandVerdict::kOtherFrame);
  EXPECT_EQ(judge.judge(commandOf(RosInput::kMalformed, {1, 0, 0}), kNow_ns), CommandVerdict::kMalformed);
  EXPECT_EQ(judge.judge(commandOf(static_cast<RosInput>(7), {1, 0, 0}), kNow_ns), CommandVerdict::kMalformed);
  EXPECT_EQ(judge.pull().force_until_ns, 0);
}

TEST(CommandJudge, ForcesAreCutToWhatTheDeviceMakes) {
  const double most_N = device().force_max_N;
  for (const Vec3& asked : {Vec3(1e3, 0, 0), Vec3(-3e9, 4e9, 12e9), Vec3(1e300, 1e300, 1e300), Vec3(1e-320, 0, 0),
                            Vec3(std::numeric_limits<double>::max(), 1, -std::numeric_limits<double>::max())}) {
    CommandJudge judge(device());
    judge.judge(commandOf(RosInput::kServoCf, {asked.x(), asked.y(), asked.z()}), kNow_ns);
    EXPECT_TRUE(judge.pull().force_N.allFinite());
    EXPECT_LE(judge.pull().force_N.norm(), most_N * (1 + 1e-12));
    if (asked.cwiseAbs().maxCoeff() > most_N) {
      const Vec3 direction = (asked / asked.cwiseAbs().maxCoeff()).normalized();
      EXPECT_LT((judge.pull().force_N - most_N * direction).norm(), 1e-9);
    }
  }
}

TEST(CommandJudge, SetPointsAreCutToTheWorkspace) {
  CommandJudge judge(device());
  judge.judge(commandOf(RosInput::kServoCp, {1e300, -1e300, 0}), kNow_ns);
  EXPECT_EQ(judge.pull().place_D, Vec3(device().workspace_max.x(), device().workspace_min.y(), 0));
}

TEST(CommandJudge, TheEndIsTakenOnce) {
  CommandJudge judge(device());
  EXPECT_FALSE(judge.takeEnd(kNow_ns));
  judge.judge(commandOf(RosInput::kServoCf, {1, 0, 0}), kNow_ns);
  EXPECT_FALSE(judge.takeEnd(kNow_ns + 49'999'999));
  EXPECT_TRUE(judge.takeEnd(kNow_ns + 50'000'000));
  EXPECT_FALSE(judge.takeEnd(kNow_ns + 60'000'000));
}

}  // namespace
}  // namespace hl::test_command_judge
