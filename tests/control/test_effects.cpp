// The forces that the servo owns, by their closed forms, and the user's limits.
#include "control/effects.h"

#include <gtest/gtest.h>

#include "control/servo_options.h"

namespace hl::test_effects {
namespace {

DeviceSample at(const Vec3& position) {
  DeviceSample sample;
  sample.position = position;
  sample.status = DeviceStatus::kOk;
  return sample;
}

TEST(Effects, NoneIsNoForce) {
  EXPECT_EQ(effectForce({}, at(Vec3(0.1, 0.2, 0.3)), Vec3(1, 1, 1), false), Vec3(Vec3::Zero()));
}

TEST(Effects, AToolAndTheDevicesOwnWeightAreHeldUp) {
  Effects effects;
  effects.tool_mass_kg = 0.1;
  DeviceSample sample = at(Vec3::Zero());
  sample.weight_N = Vec3(0.1, 0.5, -0.2);
  const Vec3 force_N = effectForce(effects, sample, Vec3::Zero(), true);
  EXPECT_LT((force_N - Vec3(0.1, 0.5 + 0.980665, -0.2)).norm(), 1e-12);
}

TEST(Effects, DragOpposesTheSpeedInTheOpenOnly) {
  Effects effects;
  effects.free_damping_Ns_m = 2;
  const Vec3 velocity(0.1, -0.2, 0.3);
  EXPECT_EQ(effectForce(effects, at(Vec3::Zero()), velocity, false), Vec3(-2 * velocity));
  EXPECT_EQ(effectForce(effects, at(Vec3::Zero()), velocity, true), Vec3(Vec3::Zero()));
}

TEST(Effects, TheSpringPullsToItsPlaceAndTheConstantForceStays) {
  Effects effects;
  effects.spring_N_m = 100;
  effects.spring_D = Vec3(0.01, 0, 0);
  effects.constant_N = Vec3(0, 0, 1);
  EXPECT_LT((effectForce(effects, at(Vec3(0, 0.02, 0)), Vec3::Zero(), false) - Vec3(1, -2, 1)).norm(), 1e-12);
}

/// A servo that is on, with these options, its finger moving at `velocity`.
Vec3 settledForce(const ServoOptions& options, const Vec3& position, const Vec3& velocity_m_s) {
  ServoSettings settings;
  settings.force_limit_N = 8;
  settings.force_rate_limit_N_s = 10'000;
  settings.velocity_limit_m_s = 3;
  settings.stiffness_N_m = 1000;
  options.apply(settings);
  ServoState state;
  arm(state);
  Vec3 force_N = Vec3::Zero();
  for (std::int64_t i = 0; i < 1000; ++i) {
    DeviceSample sample = at(position + velocity_m_s * 1e-3 * static_cast<double>(i - 999));
    sample.time_ns = 1'000'000 * (i + 1);
    force_N = stepServo(state, settings, {Vec3::Zero(), sample.time_ns, false}, sample).force_N;
  }
  return force_N;
}

TEST(ServoOptions, EffectsReachTheHandWithinTheUsersLimit) {
  ServoOptions options;
  options.effects.spring_N_m = 100;
  options.effects.free_damping_Ns_m = 2;
  EXPECT_LT((settledForce(options, Vec3(-0.02, 0, 0), Vec3(0, 0.1, 0)) - Vec3(2, -0.2, 0)).norm(), 1e-6);
  options.force_limit_N = 0.5;
  EXPECT_NEAR(settledForce(options, Vec3(-0.02, 0, 0), Vec3(0, 0.1, 0)).norm(), 0.5, 1e-9);
}

TEST(ServoOptions, LimitsOnlyLower) {
  ServoSettings settings;
  settings.force_limit_N = 3;
  settings.velocity_limit_m_s = 1;
  ServoOptions options;
  options.force_limit_N = 100;
  options.speed_limit_m_s = 100;
  options.apply(settings);
  EXPECT_EQ(settings.force_limit_N, 3);
  EXPECT_EQ(settings.velocity_limit_m_s, 1);
  options.speed_limit_m_s = 0.5;
  options.apply(settings);
  EXPECT_EQ(settings.velocity_limit_m_s, 0.5);
}

}  // namespace
}  // namespace hl::test_effects
