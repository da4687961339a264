// How a hand moves, from the moments of its servo: by closed forms.
#include "ros/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hl::test_hand_motion {
namespace {

constexpr std::int64_t kBegin_ns = 5'000'000'000;

ServoMoment momentAt(std::int64_t time_ns, const Vec3& finger_D) {
  ServoMoment moment;
  moment.time_ns = time_ns;
  moment.finger_D = finger_D;
  return moment;
}

// A servo of this rate along a path of time in s, for a tenth of a second.
template <typename Path>
void run(LogRing<ServoMoment>& moments, double rate_Hz, const Path& path) {
  for (double t_s = 0; t_s < 0.1; t_s += 1 / rate_Hz)
    moments.push(momentAt(kBegin_ns + static_cast<std::int64_t>(1e9 * t_s), path(t_s)));
}

TEST(HandMotion, OfAStraightWayTheSlopeIsTheVelocity) {
  const Vec3 velocity(0.3, -0.2, 0.05);
  for (const double rate_Hz : {100.0, 500.0, 1000.0, 4000.0, 10'000.0}) {
    LogRing<ServoMoment> moments(1024);
    run(moments, rate_Hz, [&](double t_s) { return Vec3(Vec3(0.01, 0.02, 0.03) + t_s * velocity); });
    const auto motion = newestMotion(moments);
    ASSERT_TRUE(motion);
    EXPECT_LT((motion->velocity_m_s - velocity).norm(), 1e-6) << rate_Hz;
  }
}

// Of x = a t^2 / 2 the slope over a time w is the speed at its middle, so it is late by w / 2.
TEST(HandMotion, UnderAccelerationItIsLateByHalfOfItsTime) {
  LogRing<ServoMoment> moments(1024);
  run(moments, 1000, [](double t_s) { return Vec3(0.5 * 4 * t_s * t_s, 0, 0); });
  const auto motion = newestMotion(moments);
  const double newest_s = 1e-9 * static_cast<double>(motion->newest.time_ns - kBegin_ns);
  EXPECT_NEAR(motion->velocity_m_s.x(), 4 * (newest_s - 0.5e-9 * kSlope_ns), 1e-6);
}

TEST(HandMotion, WithoutMomentsThereIsNone) {
  LogRing<ServoMoment> moments(1024);
  EXPECT_FALSE(newestMotion(moments));
  moments.push(momentAt(kBegin_ns, Vec3(1, 2, 3)));
  EXPECT_EQ(newestMotion(moments)->velocity_m_s, Vec3(Vec3::Zero()));
}

TEST(HandMotion, NoneOfADeviceThatDoesNotAnswerAndNoJumpWhenItIsBack) {
  LogRing<ServoMoment> moments(1024);
  run(moments, 1000, [](double) { return Vec3(0.1, 0, 0); });
  ServoMoment lost = momentAt(kBegin_ns + 101'000'000, Vec3::Zero());
  lost.answered = 0;
  moments.push(lost);
  EXPECT_FALSE(newestMotion(moments));
  moments.push(momentAt(kBegin_ns + 102'000'000, Vec3(0.2, 0, 0)));
  EXPECT_EQ(newestMotion(moments)->velocity_m_s, Vec3(Vec3::Zero()));
}

TEST(HandMotion, AllOfItIsInTheState) {
  HandMotion motion;
  motion.newest = momentAt(kBegin_ns, Vec3(1, 2, 3));
  motion.newest.force_N = Vec3(4, 5, 6);
  motion.newest.buttons = 0b110;
  motion.velocity_m_s = Vec3(7, 8, 9);
  motion.newest.stylus.turned = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  motion.newest.stylus.spin_rad_s = Vec3(-1, -2, -3);
  motion.newest.stylus.gripper_rad = 0.25;
  motion.newest.stylus.gripper_N = 1.5;
  const RosHandState state = stateOf(3, motion, true, 1'000);
  EXPECT_EQ(state.hand, 3u);
  EXPECT_EQ(state.buttons, 6u);
  EXPECT_EQ(state.time_ns, kBegin_ns + 1'000);
  EXPECT_EQ(state.position, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(state.orientation, (std::array<double, 4>{-0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(state.angular_velocity, (std::array<double, 3>{-1, -2, -3}));
  EXPECT_EQ(state.has_gripper, 1u);
  EXPECT_EQ(state.gripper_rad, 0.25);
  EXPECT_EQ(state.gripper_N, 1.5);
  EXPECT_EQ(stateOf(3, motion, false, 0).has_gripper, 0u);
  EXPECT_EQ(state.force, (std::array<double, 3>{4, 5, 6}));
  EXPECT_EQ(state.velocity, (std::array<double, 3>{7, 8, 9}));
  EXPECT_EQ(state.torque, (std::array<double, 3>{}));
}

}  // namespace
}  // namespace hl::test_hand_motion
