// What of a robot far away a hand is to feel, and how much energy it may bring.
#include "ros/remote_judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "device/device_models.h"

namespace hl::test_remote_judge {
namespace {

constexpr std::int64_t kBegin_ns = 9'000'000'000, kMillisecond_ns = 1'000'000;

class RemoteJudgeTest : public ::testing::Test {
 protected:
  CommandVerdict say(RosInput input, const std::array<double, 3>& value, std::int64_t age_ns = 0,
                     std::uint64_t writer = 1, std::uint64_t own_frame = 1) {
    HandCommand command;
    command.input = input;
    command.own_frame = own_frame;
    command.age_ns = age_ns;
    command.arrived_ns = now_ns_;
    command.value = value;
    command.writer = writer;
    return judge_.judge(command, now_ns_);
  }
  CommandVerdict sayTotal(double total_J, std::uint64_t writer = 1) {
    now_ns_ += 4 * kMillisecond_ns;
    return say(RosInput::kRemoteEnergy, {total_J, 0, 0}, 0, writer);
  }
  static TeleopSettings settings() {
    TeleopSettings settings;
    settings.scale = 2;
    settings.force_scale = 0.5;
    return settings;
  }

  const DeviceInfo device_ = premium10().info;
  std::int64_t now_ns_ = kBegin_ns;
  RemoteJudge judge_{device_, settings()};
};

TEST_F(RemoteJudgeTest, AForceIsScaledAndCutAndCountsFromItsArrival) {
  EXPECT_EQ(say(RosInput::kRemoteCf, {0, 4, 0}, 100 * kMillisecond_ns), CommandVerdict::kTaken);
  EXPECT_EQ(judge_.input().force_N, Vec3(0, 2, 0));
  EXPECT_EQ(judge_.input().fresh_until_ns, kBegin_ns + kRemoteLife_ns);
  EXPECT_TRUE(judge_.input().on);
  say(RosInput::kRemoteCf, {0, 1e300, 1e300});
  EXPECT_NEAR(judge_.input().force_N.norm(), device_.force_max_N, 1e-9);
}

// Clocks that differ by an hour, either way.
TEST_F(RemoteJudgeTest, OfTheAgeOnlyWhatIsMoreThanUsualCounts) {
  for (const std::int64_t offset_ns : {3'600'000'000'000, -3'600'000'000'000}) {
    const auto writer = static_cast<std::uint64_t>(offset_ns);
    EXPECT_EQ(say(RosInput::kRemoteCf, {1, 0, 0}, offset_ns, writer), CommandVerdict::kTaken);
    EXPECT_EQ(say(RosInput::kRemoteCf, {1, 0, 0}, offset_ns + 400 * kMillisecond_ns, writer), CommandVerdict::kTaken);
    EXPECT_EQ(say(RosInput::kRemoteCf, {1, 0, 0}, offset_ns + 600 * kMillisecond_ns, writer), CommandVerdict::kStale);
  }
}

TEST_F(RemoteJudgeTest, WhatWaitedHereTooLongIsStale) {
  HandCommand command{RosInput::kRemoteCf, 0, 1, 0, kBegin_ns - 51 * kMillisecond_ns, {1, 0, 0}, 1};
  EXPECT_EQ(judge_.judge(command, kBegin_ns), CommandVerdict::kStale);
  command.arrived_ns = kBegin_ns + kMillisecond_ns;
  EXPECT_EQ(judge_.judge(command, kBegin_ns), CommandVerdict::kStale);
}

// A joule at the robot is force scale / scale = 1/4 at the hand.
TEST_F(RemoteJudgeTest, ATotalCountsByWhatItHasGrown) {
  EXPECT_EQ(sayTotal(5), CommandVerdict::kTaken);  // what was before is not known
  EXPECT_EQ(judge_.input().given_up_J, 0);
  sayTotal(5.004);
  EXPECT_NEAR(judge_.input().given_up_J, 0.001, 1e-12);
  sayTotal(5.001);
  sayTotal(5.004);
  EXPECT_NEAR(judge_.input().given_up_J, 0.001, 1e-12);
}

TEST_F(RemoteJudgeTest, ARobotThatBeginsAnewCountsFromThere) {
  sayTotal(5);
  sayTotal(5.004);
  sayTotal(0.1, 2);
  EXPECT_NEAR(judge_.input().given_up_J, 0.001, 1e-12);
  sayTotal(0.104, 2);
  EXPECT_NEAR(judge_.input().given_up_J, 0.002, 1e-12);
}

TEST_F(RemoteJudgeTest, ATotalGrowsNoFasterThanTheDeviceCouldTake) {
  sayTotal(0);
  sayTotal(1e9);
  EXPECT_NEAR(judge_.input().given_up_J, 4e-3 * device_.force_max_N * device_.velocity_max_m_s, 1e-9);
}

TEST_F(RemoteJudgeTest, WhatCannotBeTrustedChangesNothing) {
  EXPECT_EQ(say(RosInput::kRemoteCf, {NAN, 0, 0}), CommandVerdict::kNotANumber);
  EXPECT_EQ(sayTotal(HUGE_VAL), CommandVerdict::kNotANumber);
  EXPECT_EQ(say(RosInput::kRemoteCf, {1, 0, 0}, 0, 1, 0), CommandVerdict::kOtherFrame);
  EXPECT_EQ(say(RosInput::kServoCf, {1, 0, 0}), CommandVerdict::kMalformed);
  EXPECT_EQ(judge_.input().force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(judge_.input().fresh_until_ns, 0);
  EXPECT_EQ(judge_.input().given_up_J, 0);
}

}  // namespace
}  // namespace hl::test_remote_judge
