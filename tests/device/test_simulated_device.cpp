// Simulated device: forces as commanded, energy, encoder steps, hand, repeatability, nothing allocated.
#include "device/simulated_device.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/no_alloc.h"

namespace hl {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
const PhantomParameters kArm;

/// One DAC count of each joint as the force it makes at the tip, N, added up.
double dacCount_N(const Vec3& q) {
  const Vec3 count = 2 * kArm.motor_torque_peak_Nm * kArm.gear / std::pow(2.0, kArm.dac_bits);
  return (phantomJacobian(kArm, q).transpose().inverse() * Mat3(count.asDiagonal())).cwiseAbs().rowwise().sum().norm();
}

SimulatedDeviceSettings unheld() {
  SimulatedDeviceSettings settings;
  settings.held = false;
  return settings;
}

TEST(SimulatedDevice, StaticForceAtTheTipIsTheCommandedOneWithinOneDacCount) {
  SimulatedDevice device;
  std::mt19937 random(1);
  std::uniform_real_distribution<> component(-0.8, 0.8);  // any direction within the 1.4 N that may be held
  std::int64_t now_ns = 0;
  device.read(now_ns);
  for (int n = 0; n < 200; ++n) {
    const Vec3 force(component(random), component(random), component(random));
    device.setHandGoal(0.05 * force);
    for (int i = 0; i < 200; ++i) {
      device.read(now_ns += kPeriod_ns);
      device.write(force);
    }
    // The torque is computed at what the encoders say, up to one step off: 1.2e-4 rad of a 1.4 N force.
    EXPECT_LT((device.motorForce() - force).norm(), dacCount_N(device.joints()) + 1.4e-4 * 2 * 1.4);
  }
}

TEST(SimulatedDevice, TorqueIsInWholeDacCountsAndNeverAboveThePeak) {
  SimulatedDevice device;
  std::mt19937 random(2);
  std::uniform_real_distribution<> component(-50, 50);
  const Vec3 peak = kArm.motor_torque_peak_Nm * kArm.gear;
  for (int n = 0; n < 1000; ++n) {
    device.write({component(random), component(random), component(random)});
    for (int i = 0; i < 3; ++i) {
      const double counts = device.motorTorque_Nm()[i] / (2 * peak[i] / 65536);
      EXPECT_NEAR(counts, std::round(counts), 1e-6);
      EXPECT_LE(std::abs(device.motorTorque_Nm()[i]), peak[i]);
    }
  }
  device.write(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(device.motorTorque_Nm(), Vec3(Vec3::Zero()));
}

TEST(SimulatedDevice, ReadingIsTheTipWithinOneEncoderStep) {
  SimulatedDevice device;
  EXPECT_LT(device.trueTip_D().norm(), 1e-12);
  device.setHandGoal({0.06, -0.04, 0.03});
  for (std::int64_t i = 0; i < 2000; ++i) {
    const DeviceSample sample = device.read(i * kPeriod_ns);
    ASSERT_EQ(sample.status, DeviceStatus::kOk);
    EXPECT_EQ(sample.time_ns, i * kPeriod_ns);
    EXPECT_LT((sample.position - device.trueTip_D()).norm(), 3 * device.info().resolution_m);  // three joints
  }
}

TEST(SimulatedDevice, WholeWorkspaceBoxIsWithinReachOfTheHand) {
  for (int corner = 0; corner < 8; ++corner) {
    SimulatedDevice device;
    device.setHandFirm(true);
    Vec3 goal;
    for (int i = 0; i < 3; ++i)
      goal[i] = (corner >> i & 1) ? device.info().workspace_max[i] : device.info().workspace_min[i];
    device.setHandGoal(goal);
    for (std::int64_t i = 0; i < 3000; ++i) device.read(i * kPeriod_ns);
    // Joint friction, .06 N at 265 N/m, holds the tip back by a fraction of a millimetre.
    EXPECT_LT((device.trueTip_D() - goal).norm(), 1e-3) << goal.transpose();
  }
}

TEST(SimulatedDevice, EnergyOfThePassiveArmNeverGrows) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> rate(-5, 5);
  for (int n = 0; n < 10; ++n) {
    SimulatedDevice device(unheld());
    device.setJoints(device.joints(), {rate(random), rate(random), rate(random)});
    double energy_J = device.energy_J();
    std::int64_t now_ns = 0;
    device.read(now_ns);
    for (int i = 0; i < 300'000; ++i) {  // 3 s in the steps of the integration
      device.read(now_ns += 10'000);
      const double next_J = device.energy_J();
      ASSERT_LE(next_J, energy_J + 1e-9 + 1e-5 * energy_J) << i;  // error of one semi-implicit step in a stop
      energy_J = next_J;
    }
    // Friction has stopped it, against a stop at most as far in as friction holds: (0.01 N m)^2 / (2 * 20 N m/rad)
    // each.
    EXPECT_LT(energy_J, 4 * 2.5e-6);
  }
}

TEST(SimulatedDevice, EnergyOfTheHeldArmNeverGrowsWhenTheHandWantsNothing) {
  for (const bool firm : {false, true}) {
    SimulatedDeviceSettings settings;
    settings.firm = firm;
    SimulatedDevice device(settings);
    device.setJoints(device.joints(), {2, -3, 3});
    double energy_J = device.energy_J();
    std::int64_t now_ns = 0;
    device.read(now_ns);
    for (int i = 0; i < 100'000; ++i) {
      device.read(now_ns += 10'000);
      const double next_J = device.energy_J();
      ASSERT_LE(next_J, energy_J + 1e-12) << i;  // rounding
      energy_J = next_J;
    }
  }
}

TEST(Hand, WantsNoFasterThanItsSpeedLimitAndDoesNotOvershoot) {
  HandState hand;
  const Vec3 goal(0.1, 0.05, -0.03);
  for (int i = 0; i < 200'000; ++i) {
    stepWish(hand, goal, 1e-5);
    ASSERT_LE(hand.wish_velocity.norm(), 0.3 * (1 + 1e-12));
    ASSERT_LE(hand.wish.norm(), goal.norm() * (1 + 1e-9));
  }
  EXPECT_LT((hand.wish - goal).norm(), 1e-6);
}

TEST(SimulatedDevice, HandBringsTheTipToItsGoal) {
  SimulatedDevice device;
  std::int64_t now_ns = 0;
  for (int i = 0; i < 500; ++i) device.read(now_ns += kPeriod_ns);
  const Vec3 goal(0.1, 0.05, -0.03);
  device.setHandGoal(goal);
  for (int i = 0; i < 2000; ++i) device.read(now_ns += kPeriod_ns);
  EXPECT_LT((device.trueTip_D() - goal).norm(), 1e-3);
}

TEST(SimulatedDevice, GoalsThatAreNoNumbersAreIgnored) {
  SimulatedDevice device;
  device.setHandGoal(Vec3::Constant(std::numeric_limits<double>::infinity()));
  for (std::int64_t i = 0; i < 100; ++i) device.read(i * kPeriod_ns);
  EXPECT_LT(device.trueTip_D().norm(), 1e-4);
}

TEST(SimulatedDevice, LongGapsAndClocksThatGoBackAreHarmless) {
  SimulatedDevice device;
  device.setHandGoal({0.02, 0, 0});
  for (const std::int64_t now_ns :
       {std::int64_t{0}, std::int64_t{5'000'000'000}, std::int64_t{1'000}, std::int64_t{0}}) {
    const DeviceSample sample = device.read(now_ns);
    EXPECT_TRUE(sample.position.allFinite());
    EXPECT_LT(sample.position.norm(), 0.01);  // 20 ms at most of the five seconds
  }
}

TEST(SimulatedDevice, SameCallsGiveTheSameBits) {
  SimulatedDevice one, two;
  for (std::int64_t i = 0; i < 1000; ++i) {
    const Vec3 force(std::sin(0.01 * static_cast<double>(i)), 0.3, -0.2);
    for (SimulatedDevice* device : {&one, &two}) {
      device->setHandGoal(0.01 * force);
      device->write(force);
    }
    ASSERT_EQ(one.read(i * kPeriod_ns).position, two.read(i * kPeriod_ns).position);
  }
  EXPECT_EQ(one.trueTip_D(), two.trueTip_D());
}

TEST(SimulatedDevice, ReadAndWriteDoNotAllocate) {
  SimulatedDevice device;
  const NoAlloc guard;
  for (std::int64_t i = 0; i < 100; ++i) {
    device.setHandGoal({0.01, 0, 0});
    device.read(i * kPeriod_ns);
    device.write({1, 0, 0});
  }
}

}  // namespace
}  // namespace hl
