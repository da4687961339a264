// Simulated device: forces as commanded, energy, encoder steps, hand, repeatability, nothing allocated.
#include "device/simulated_device.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/error.h"
#include "cases.h"
#include "device/person_script.h"
#include "device/phantom_arm.h"
#include "guard/realtime_guard.h"

namespace hl::test_simulated_device {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
const PhantomParameters kArm;

/// One DAC count of each joint as the force it makes at the tip, N, added up.
double dacCount_N(const Vec3& q) {
  const Vec3 count = 2 * kArm.motor_torque_peak_Nm * kArm.gear / std::pow(2.0, kArm.dac_bits);
  return (phantomJacobian(kArm, q).transpose().inverse() * Mat3(count.asDiagonal())).cwiseAbs().rowwise().sum().norm();
}

PhantomArm& phantomOf(SimulatedDevice& device) { return dynamic_cast<PhantomArm&>(device.arm()); }

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
  for (int n = 0; n < test::cases(200); ++n) {
    const Vec3 force(component(random), component(random), component(random));
    device.setHandGoal(0.05 * force);
    for (int i = 0; i < 200; ++i) {
      device.read(now_ns += kPeriod_ns);
      device.write(force);
    }
    device.read(now_ns += 10'000);
    // The torque is computed at what the encoders say, up to one step off: 1.2e-4 rad of a 1.4 N force.
    EXPECT_LT((device.arm().motorForce_N() - force).norm(), dacCount_N(phantomOf(device).joints()) + 1.4e-4 * 2 * 1.4);
  }
}

TEST(SimulatedDevice, TorqueIsInWholeDacCountsAndNeverAboveThePeak) {
  SimulatedDevice device;
  std::mt19937 random(2);
  std::uniform_real_distribution<> component(-50, 50);
  const Vec3 peak = kArm.motor_torque_peak_Nm * kArm.gear;
  std::int64_t now_ns = 0;
  device.read(now_ns);
  for (int n = 0; n < 1000; ++n) {
    device.write({component(random), component(random), component(random)});
    device.read(now_ns += kPeriod_ns);
    const Vec3 torque_Nm = phantomOf(device).motorTorque_Nm();
    for (int i = 0; i < 3; ++i) {
      const double counts = torque_Nm[i] / (2 * peak[i] / 65536);
      EXPECT_NEAR(counts, std::round(counts), 1e-6);
      EXPECT_LE(std::abs(torque_Nm[i]), peak[i]);
    }
  }
  device.write(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  device.read(now_ns += kPeriod_ns);
  EXPECT_EQ(phantomOf(device).motorTorque_Nm(), Vec3(Vec3::Zero()));
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
  for (int n = 0; n < test::cases(10); ++n) {
    SimulatedDevice device(unheld());
    phantomOf(device).setJoints(phantomOf(device).joints(), {rate(random), rate(random), rate(random)});
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
    phantomOf(device).setJoints(phantomOf(device).joints(), {2, -3, 3});
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

SimulatedDeviceSettings withEverything() {
  SimulatedDeviceSettings settings;
  settings.bends = true;
  settings.current_lag_s = 0.25e-3;
  settings.delay_steps = 2;
  settings.jitter_s = 50e-6;
  return settings;
}

TEST(SimulatedDevice, ReadAndWriteDoNotAllocate) {
  SimulatedDevice device(withEverything());
  const RealtimeGuard guard;
  for (std::int64_t i = 0; i < 100; ++i) {
    device.setHandGoal({0.01, 0, 0});
    device.read(i * kPeriod_ns);
    device.write({1, 0, 0});
  }
}

TEST(SimulatedDevice, EveryModelIsFoundByItsNameAndHoldsWhatItsSheetSays) {
  for (const DeviceModel& model : deviceModels()) {
    SimulatedDeviceSettings settings;
    settings.model = deviceModel(model.name);
    settings.firm = true;
    SimulatedDevice device(settings);
    EXPECT_EQ(device.info().name, model.info.name);
    const Vec3 goal = 0.5 * device.info().workspace_max;
    device.setHandGoal(goal);
    for (std::int64_t i = 0; i < 2000; ++i) device.read(i * kPeriod_ns);
    // The hand's springs in series, 267 N/m, against friction.
    EXPECT_LT((device.trueTip_D() - goal).norm(), 1e-3 + device.info().friction_N / 200) << model.name;
    device.write({100, 0, 0});
    device.read(2001 * kPeriod_ns);
    EXPECT_GE(device.arm().motorForce_N().norm(), 0.6 * device.info().force_max_N) << model.name;
  }
  EXPECT_THROW(deviceModel("premium"), Error);
}

// One mass in closed form: m x'' = f - b x'.
TEST(SimulatedDevice, TheLinearDeviceMovesAsItsEquationSays) {
  constexpr double kMass_kg = 0.075, kDamping_Ns_m = 0.5, kForce_N = 0.3, kTime_s = 0.2;
  SimulatedDeviceSettings settings = unheld();
  settings.model = linearDevice(kMass_kg, kDamping_Ns_m);
  settings.step_s = 5e-6;
  SimulatedDevice device(settings);
  device.read(0);
  device.write({0, kForce_N, 0});
  DeviceSample sample;
  for (std::int64_t i = 1; i <= 200; ++i) sample = device.read(i * kPeriod_ns);
  const double rate = kDamping_Ns_m / kMass_kg;
  const double way_m = kForce_N / kDamping_Ns_m * (kTime_s - (1 - std::exp(-rate * kTime_s)) / rate);
  EXPECT_NEAR(sample.position.y(), way_m, 1e-4 * way_m);
}

TEST(SimulatedDevice, FrictionHoldsAMassUnderALoadThatIsLessAndBrakesItUnderMore) {
  for (const double load_N : {0.037, 0.138}) {
    SimulatedDeviceSettings settings = unheld();
    settings.model = premium10();
    settings.load_N = Vec3(0, 0.6, -0.8) * load_N;
    SimulatedDevice device(settings);
    for (std::int64_t i = 0; i <= 100; ++i) device.read(i * kPeriod_ns);
    const double expected_m_s = load_N > 0.038 ? (load_N - 0.038) / 0.005 * (1 - std::exp(-0.1 * 0.005 / 0.072)) : 0;
    EXPECT_NEAR(device.trueVelocity_D().norm(), expected_m_s, 1e-3 * expected_m_s);
  }
}

TEST(SimulatedDevice, AForceArrivesAfterItsStepsOfDelay) {
  for (const int delay : {0, 1, 4}) {
    SimulatedDeviceSettings settings = unheld();
    settings.model = premium10();
    settings.delay_steps = delay;
    SimulatedDevice device(settings);
    device.read(0);
    for (int i = 0; i < 8; ++i) {
      device.write({i == 0 ? 1.0 : 0.0, 0, 0});
      device.read((i + 1) * kPeriod_ns);
      EXPECT_NEAR(device.arm().motorForce_N().x(), i == delay ? 1 : 0, 1e-3) << delay << " " << i;
    }
  }
}

TEST(SimulatedDevice, CurrentComesAsSlowlyAsItsLagSays) {
  SimulatedDeviceSettings settings = unheld();
  settings.model = premium10();
  settings.current_lag_s = 0.25e-3;
  SimulatedDevice device(settings);
  device.read(0);
  device.write({1, 0, 0});
  device.read(250'000);
  EXPECT_NEAR(device.arm().motorForce_N().x(), 1 - std::exp(-1), 1e-3);
}

// The stylus swings behind a locked arm at sqrt(k / m) and loses energy as its damping says.
TEST(SimulatedDevice, TheBendingStylusSwingsAtItsFrequency) {
  SimulatedDeviceSettings settings = unheld();
  settings.model = linearDevice(1e6, 0);
  settings.bends = true;
  settings.step_s = 1e-6;
  SimulatedDevice device(settings);
  device.read(0);
  device.place(Vec3::Zero(), Vec3::Zero());
  settings.load_N = Vec3(0, 1, 0);
  SimulatedDevice pulled(settings);
  pulled.read(0);
  double highest_m = 0, highest_s = 0;
  for (std::int64_t i = 1; i < 600; ++i) {
    pulled.read(i * 10'000);
    if (pulled.trueTip_D().y() <= highest_m) continue;
    highest_m = pulled.trueTip_D().y();
    highest_s = 1e-5 * static_cast<double>(i);
  }
  const double half_s = M_PI / std::sqrt(3500 / 0.010);
  EXPECT_NEAR(highest_s, half_s, 0.01 * half_s);
  EXPECT_NEAR(highest_m, (1 + std::exp(-M_PI * 0.02)) / 3500, 1e-6);
}

TEST(SimulatedDevice, EnergyOfABendingArmThatIsHeldNeverGrows) {
  SimulatedDeviceSettings settings;
  settings.model = premium10();
  settings.bends = true;
  settings.step_s = 1e-6;
  SimulatedDevice device(settings);
  device.arm().place(Vec3::Zero(), {0.3, -0.2, 0.1});
  double energy_J = device.energy_J();
  std::int64_t now_ns = 0;
  device.read(now_ns);
  for (int i = 0; i < 20'000; ++i) {
    device.read(now_ns += 10'000);
    ASSERT_LE(device.energy_J(), energy_J + 1e-6 * energy_J) << i;
    energy_J = device.energy_J();
  }
}

TEST(SimulatedDevice, JitterTakesReadingsLaterButNoLaterThanItSaysAndTheSameEveryTime) {
  SimulatedDeviceSettings settings = unheld();
  settings.model = linearDevice(1, 0);
  settings.jitter_s = 100e-6;
  SimulatedDevice one(settings), two(settings);
  for (SimulatedDevice* device : {&one, &two}) {
    device->read(0);
    device->place(Vec3::Zero(), {0.1, 0, 0});  // where it is shows when
  }
  double least_s = 1, most_s = 0, first_s = 0;
  for (std::int64_t i = 1; i < 1000; ++i) {
    const DeviceSample sample = one.read(i * kPeriod_ns);
    ASSERT_EQ(sample.position, two.read(i * kPeriod_ns).position);
    EXPECT_EQ(sample.time_ns, i * kPeriod_ns);
    const double late_s = 10 * sample.position.x() - 1e-3 * static_cast<double>(i);
    if (i == 1) first_s = late_s;
    least_s = std::min(least_s, late_s - first_s);
    most_s = std::max(most_s, late_s - first_s);
  }
  EXPECT_LE(most_s - least_s, 100.01e-6);
  EXPECT_GT(most_s - least_s, 90e-6);
}

TEST(SimulatedDevice, AHandThatLetsGoLeavesTheArmToItselfAndTakesItAgainWhereItIs) {
  SimulatedDeviceSettings settings;
  settings.model = premium10();
  settings.load_N = Vec3(0.2, 0, 0);
  SimulatedDevice device(settings);
  std::int64_t now_ns = 0;
  for (int i = 0; i < 500; ++i) device.read(now_ns += kPeriod_ns);
  EXPECT_LT(device.trueTip_D().norm(), (0.2 + 0.038) / 120) << "the hand's springs in series hold the load";
  device.setHandHolds(false);
  for (int i = 0; i < 150; ++i) device.read(now_ns += kPeriod_ns);
  const double gone_m = device.trueTip_D().x();
  EXPECT_GT(gone_m, 0.01);
  device.setHandHolds(true);
  for (int i = 0; i < 1000; ++i) device.read(now_ns += kPeriod_ns);
  EXPECT_GT(device.trueTip_D().x(), gone_m);
  EXPECT_LT(device.trueVelocity_D().norm(), 1e-3);
}

TEST(PersonScript, DoesOneThingAfterTheOther) {
  test::PersonScript person({0, 0.01, 0}, 0.5);
  person.press({0, -0.02, 0}, 0.1, 1).tap({0, -0.005, 0}, 0.05, 2).letGo(0.3);
  EXPECT_EQ(person.at(0.25), Vec3(0, 0.01, 0));
  EXPECT_NEAR(person.at(0.6).y(), 0, 1e-12);
  EXPECT_NEAR(person.at(1.2).y(), -0.01, 1e-12);
  EXPECT_NEAR(person.at(1.9).y(), 0.01, 1e-12);
  EXPECT_NEAR(person.duration_s(), 0.5 + 1.4 + 2 * 0.201 + 0.3, 1e-9);
  EXPECT_TRUE(person.holdsAt(2.2));
  EXPECT_FALSE(person.holdsAt(person.duration_s() - 0.15));
  EXPECT_TRUE(person.holdsAt(person.duration_s()));
}

}  // namespace
}  // namespace hl::test_simulated_device
