// How a stylus is turned: what a reader makes of a driver's readings, and the simulated wrist.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "device/hand_script.h"
#include "device/simulated_device.h"
#include "device/stylus_reader.h"

namespace hl::test_stylus {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Quaterniond about(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

Eigen::Quaterniond randomTurn(std::mt19937& random) {
  std::normal_distribution<> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
}

// Turning at constant rate, the low pass of one pole is w (1 - (1 - p)^n) after n steps, p = T / (T + filter).
TEST(StylusReader, TheSpinOfAConstantTurnComesUpAsItsLowPassDoes) {
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  constexpr double kRate_rad_s = 4, kStep_s = 1e-3;
  StylusReader reader;
  Stylus reported;
  reader.read(reported, 0);
  for (int n = 1; n <= 200; ++n) {
    reported.turned = about(kRate_rad_s * kStep_s * n, axis);
    if (n % 2 == 0) reported.turned.coeffs() = -reported.turned.coeffs();  // the same orientation
    const Stylus now = reader.read(reported, n * kMillisecond_ns);
    const double part = kStep_s / (kStep_s + StylusReader::kSpinFilter_s);
    const Vec3 expected = kRate_rad_s * (1 - std::pow(1 - part, n)) * axis;
    ASSERT_LT((now.spin_rad_s - expected).norm(), 1e-9) << n;
    ASSERT_LT(now.turned.angularDistance(reported.turned), 1e-12);
  }
}

TEST(StylusReader, WhatIsNoOrientationIsLeftOut) {
  StylusReader reader;
  Stylus reported;
  reported.turned.coeffs() = 7 * about(1, Vec3::UnitX()).coeffs();
  reported.gripper_rad = 0.25;
  const Stylus good = reader.read(reported, 0);
  EXPECT_NEAR(good.turned.norm(), 1, 1e-15);
  Stylus bad = reported;
  for (const double part : {kNaN, std::numeric_limits<double>::infinity(), 0.0}) {
    bad.turned.coeffs().setConstant(part);
    bad.gripper_rad = bad.gripper_N = kNaN;
    EXPECT_EQ(reader.read(bad, kMillisecond_ns), good);
  }
  bad.turned.coeffs().setConstant(1e308);
  EXPECT_NEAR(reader.read(bad, 2 * kMillisecond_ns).turned.norm(), 1, 1e-12);
}

TEST(StylusReader, TimeThatStandsStillOrGoesBackMakesNoSpin) {
  StylusReader reader;
  Stylus reported;
  reader.read(reported, 5);
  reported.turned = about(1, Vec3::UnitY());
  EXPECT_TRUE(reader.read(reported, 5).spin_rad_s.isZero(0));
  reported.turned = about(2, Vec3::UnitY());
  EXPECT_TRUE(reader.read(reported, 4).spin_rad_s.isZero(0));
}

// From rest, about one axis: the angle left is a (1 + w t) exp(-w t).
TEST(Wrist, ComesWithoutOvershoot) {
  Wrist wrist({1e-6});
  const Eigen::Quaterniond from = Wrist::atRest(), to = about(1, Vec3(1, 1, 0)) * from;
  wrist.turnTo(Eigen::Quaterniond(-5 * to.coeffs()));
  double before = 1;
  for (int i = 1; i <= 1000; ++i) {
    wrist.step(1e-3);
    const double left = wrist.turned().angularDistance(to), wt = 2 * std::numbers::pi * 3 * i * 1e-3;
    ASSERT_LT(left, before + 1e-12);
    ASSERT_NEAR(left, (1 + wt) * std::exp(-wt), 0.01) << i;
    before = left;
  }
  EXPECT_LT(before, 1e-5);
}

TEST(Wrist, CountsItsThreeAnglesAnywhere) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    constexpr double kResolution = 1e-3;
    Wrist wrist({kResolution});
    Eigen::Quaterniond goal = randomTurn(random);
    if (i % 4 == 0) goal = about(i, Vec3::UnitY()) * about((i % 8 - 4) * std::numbers::pi / 8, Vec3::UnitX());
    wrist.turnTo(goal);
    wrist.step(20);
    EXPECT_LT(wrist.turned().angularDistance(goal), 1e-9);
    // Half a step of each angle, which add up at most.
    EXPECT_LT(wrist.counted().turned.angularDistance(goal), 1.5 * kResolution + 1e-9) << i;
    EXPECT_NEAR(wrist.counted().turned.norm(), 1, 1e-12);
  }
}

TEST(Wrist, IgnoresWhatItCannotDo) {
  Wrist none({0, 0, 0});
  none.turnTo(about(1, Vec3::UnitX()));
  none.openTo(0.3);
  none.step(1);
  EXPECT_EQ(none.counted(), Stylus{});
  Wrist wrist({1e-4, 0.5, 1.2e-4});
  const Stylus rest = wrist.counted();
  wrist.turnTo(Eigen::Quaterniond(kNaN, 0, 0, 1));
  wrist.turnTo(Eigen::Quaterniond(0, 0, 0, 0));
  wrist.openTo(kNaN);
  wrist.step(1);
  EXPECT_EQ(wrist.counted(), rest);
  wrist.openTo(7);
  wrist.step(5);
  EXPECT_NEAR(wrist.counted().gripper_rad, 0.5, 1e-4);
  EXPECT_LE(wrist.counted().gripper_rad, 0.5);
  wrist.openTo(-7);
  wrist.step(5);
  EXPECT_EQ(wrist.counted().gripper_rad, 0);
}

TEST(SimulatedDevice, TurnsItsStylusAsTheHandWantsWhereItHasAWrist) {
  for (const DeviceModel& model : deviceModels()) {
    SimulatedDeviceSettings settings;
    settings.model = model;
    settings.step_s = 1e-4;
    SimulatedDevice device(settings);
    device.setHandTurn(about(0.8, Vec3(1, 2, 3)));
    device.setHandGripper(0.2);
    DeviceSample sample;
    for (int i = 0; i <= 1500; ++i) sample = device.read(i * kMillisecond_ns);
    const double off_rad = sample.stylus.turned.angularDistance(about(0.8, Vec3(1, 2, 3)));
    EXPECT_EQ(off_rad < 0.01, model.info.has_wrist) << model.name;
    EXPECT_NEAR(sample.stylus.gripper_rad, model.info.gripper_max_rad > 0 ? 0.2 : 0, 1e-3) << model.name;
  }
}

TEST(HandScript, TurnsTheShortWayRoundBetweenSamples) {
  HandScript script;
  script.samples.push_back({0, Vec3::Zero(), about(0, Vec3::UnitZ()), 0.1});
  script.samples.push_back({2, Vec3::Zero(), Eigen::Quaterniond(-about(1, Vec3::UnitZ()).coeffs()), 0.5});
  EXPECT_LT(script.turnedAt(0.5)->angularDistance(about(0.25, Vec3::UnitZ())), 1e-12);
  EXPECT_LT(script.turnedAt(9)->angularDistance(about(1, Vec3::UnitZ())), 1e-12);
  EXPECT_NEAR(*script.gripperAt(0.5), 0.2, 1e-15);
  script.samples.back().turned.reset();
  EXPECT_FALSE(script.turnedAt(0.5));
}

}  // namespace
}  // namespace hl::test_stylus
