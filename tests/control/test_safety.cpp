// The safety states under injected faults, at 1, 4 and 10 kHz: every fault reaches zero force within 2 ms of simulated
// time, and what leads out of it.
#include "control/safety.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <map>

#include "control/servo.h"
#include "control/servo_record.h"
#include "control/watchdog.h"
#include "device/simulated_device.h"

namespace hl::test_safety {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kSoon_ns = 2'000'000;

/// What one step sees; faults are injected by changing it.
struct Seen {
  ServoTarget target;
  DeviceSample sample;
};

/// A servo at some rate that pulls with 2 N, with its clock.
struct Bench {
  ServoSettings settings;
  ServoState state;
  std::int64_t period_ns;
  std::int64_t now_ns = 1'000'000'000;
  std::int64_t target_ns = -1;  ///< time of the targets; -1: now

  explicit Bench(double rate_Hz) : period_ns(static_cast<std::int64_t>(1e9 / rate_Hz)) {
    settings = ServoSettings::of(SimulatedDevice().info());
    settings.period_s = 1 / rate_Hz;
    settings.stiffness_N_m = 1000;
  }
  ServoOutput step(const std::function<void(Seen&)>& change = {}) {
    now_ns += period_ns;
    Seen seen{{Vec3(0.002, 0, 0), target_ns < 0 ? now_ns : target_ns, true},
              {now_ns, Vec3::Zero(), 1, DeviceStatus::kOk}};
    if (change) change(seen);
    return stepServo(state, settings, seen.target, seen.sample);
  }
  void run(double seconds, const std::function<void(Seen&)>& change = {}) {
    for (int i = 0; i < seconds / settings.period_s; ++i) step(change);
  }
  static Bench on(double rate_Hz) {
    Bench bench(rate_Hz);
    arm(bench.state);
    bench.run(0.6);
    EXPECT_EQ(bench.state.safety, SafetyState::kOn);
    EXPECT_NEAR(bench.state.force_N.x(), 2, 1e-9);
    return bench;
  }
  std::int64_t toZero_ns(const std::function<void(Seen&)>& change) {
    const std::int64_t begin_ns = now_ns;
    while (now_ns - begin_ns < 10 * kSoon_ns && !step(change).force_N.isZero(0)) {
    }
    return now_ns - begin_ns;
  }
};

class Rates : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Safety, Rates, testing::Values(1000, 4000, 10'000),
                         [](const auto& rate) { return std::to_string(static_cast<int>(rate.param)) + "Hz"; });

TEST_P(Rates, EveryFaultReachesZeroForceWithinTwoMilliseconds) {
  const double period_s = 1 / GetParam();
  double way_m = 0;
  const std::map<FaultReason, std::function<void(Seen&)>> faults{
      {FaultReason::kDeviceLost, [](Seen& s) { s.sample.status = DeviceStatus::kLost; }},
      {FaultReason::kNotReady, [](Seen& s) { s.sample.status = DeviceStatus::kNotReady; }},
      {FaultReason::kBadPosition, [](Seen& s) { s.sample.position.y() = kNaN; }},
      {FaultReason::kTooFast, [&](Seen& s) { s.sample.position.y() = way_m += 3.3 * period_s; }},  // a tenth too fast
      {FaultReason::kStaleTarget, [](Seen& s) { s.target.time_ns = s.sample.time_ns - 1'100'000'000; }},
      {FaultReason::kBadTarget, [](Seen& s) { s.target.proxy_D.z() = kNaN; }},
      {FaultReason::kDeadlines, [](Seen& s) { s.sample.time_ns += 1'000'000'000; }},
  };
  for (const auto& [reason, inject] : faults) {
    Bench bench = Bench::on(GetParam());
    bench.run(0.0101);  // the fault may come at any moment of a window
    EXPECT_LE(bench.toZero_ns(inject), kSoon_ns) << faultText(reason);
    EXPECT_EQ(bench.state.safety, SafetyState::kFault);
    EXPECT_EQ(bench.state.fault, reason);
    // It stays so until armed again, and then the force starts from zero.
    bench.run(0.3);
    EXPECT_EQ(bench.state.safety, SafetyState::kFault) << faultText(reason);
    EXPECT_EQ(bench.state.force_N, Vec3(Vec3::Zero()));
    arm(bench.state);
    EXPECT_LT(bench.step().force_N.norm(), 2.1 * period_s / bench.settings.ramp_s);
    EXPECT_EQ(bench.state.safety, SafetyState::kArming);
  }
}

// A window of speed that began before the blow shows half of it: whenever it comes, the next one shows all.
TEST_P(Rates, ABlowIsFoundWheneverItComes) {
  for (int offset = 0; offset < 20; ++offset) {
    Bench bench = Bench::on(GetParam());
    for (int i = 0; i < offset; ++i) bench.step();
    double way_m = 0;
    const auto blow = [&](Seen& s) { s.sample.position.y() = way_m += 3.01 * bench.settings.period_s; };
    EXPECT_LE(bench.toZero_ns(blow), kSoon_ns) << offset;
    EXPECT_EQ(bench.state.fault, FaultReason::kTooFast);
  }
}

TEST_P(Rates, AHandJustWithinTheLimitOfSpeedIsNoFault) {
  Bench bench = Bench::on(GetParam());
  double way_m = 0;
  bench.run(0.1, [&](Seen& s) {
    s.sample.position.y() = way_m += 2.99 * bench.settings.period_s;
    s.target.proxy_D = s.sample.position;
  });
  EXPECT_EQ(bench.state.safety, SafetyState::kOn);
}

// One count of 30 um between two steps that a late wake-up has brought together.
TEST_P(Rates, AnEncoderCountBetweenTwoCloseStepsIsNoBlow) {
  Bench bench = Bench::on(GetParam());
  for (int i = 0; i < 100; ++i) {
    bench.now_ns -= bench.period_ns - 1000;
    bench.step([&](Seen& s) { s.sample.position.y() = i % 2 == 0 ? 30e-6 : 0; });
    bench.run(0.001);
  }
  EXPECT_EQ(bench.state.safety, SafetyState::kOn);
}

// A driver whose thread is held up for 40 ms goes on reporting the same place, and then where the hand has gone since.
TEST_P(Rates, ADriverThatIsHeldUpLooksLikeNoBlowAndHidesNone) {
  for (const double way_m : {0.11, 0.13}) {  // in 40 ms, at 2.75 and 3.25 m/s
    Bench bench = Bench::on(GetParam());
    const std::int64_t begin_ns = bench.now_ns;
    std::int64_t reported_ns = begin_ns;
    bench.run(0.1, [&](Seen& s) {
      const std::int64_t now_ns = bench.now_ns - begin_ns;
      const bool held_up = now_ns > 30'000'000 && now_ns < 70'000'000;
      if (!held_up) reported_ns = bench.now_ns;
      s.sample.age_ns = bench.now_ns - reported_ns;
      s.sample.position.y() = now_ns < 70'000'000 ? 0 : way_m;
      s.target.proxy_D = s.sample.position;
    });
    EXPECT_EQ(bench.state.safety, way_m < 0.12 ? SafetyState::kOn : SafetyState::kFault) << way_m;
  }
}

TEST_P(Rates, AStaleTargetGivesNoForceAtOnceAndAFaultAfterASecond) {
  Bench bench = Bench::on(GetParam());
  bench.target_ns = bench.now_ns;
  bench.run(0.0495);
  EXPECT_GT(bench.state.force_N.norm(), 1.9);
  EXPECT_LE(bench.toZero_ns({}), kSoon_ns + 1'000'000);
  bench.run(0.9);
  EXPECT_EQ(bench.state.safety, SafetyState::kOn);
  bench.run(0.1);
  EXPECT_EQ(bench.state.fault, FaultReason::kStaleTarget);
}

TEST_P(Rates, ADeviceThatReturnsIsReportedAndArmsAgainOnlyWhereThatIsWanted) {
  const auto lose = [](Seen& s) { s.sample.status = DeviceStatus::kLost; };
  for (const bool arm_again : {false, true}) {
    Bench bench = Bench::on(GetParam());
    bench.settings.arm_again = arm_again;
    bench.run(0.2, lose);
    EXPECT_EQ(bench.state.fault, FaultReason::kDeviceLost);
    bench.run(0.45);
    EXPECT_EQ(bench.state.fault, FaultReason::kDeviceLost);
    bench.step(lose);  // a break: it begins anew
    bench.run(0.45);
    EXPECT_EQ(bench.state.fault, FaultReason::kDeviceLost);
    bench.run(0.1);
    EXPECT_EQ(bench.state.safety, arm_again ? SafetyState::kArming : SafetyState::kFault);
    EXPECT_EQ(bench.state.fault, arm_again ? FaultReason::kNone : FaultReason::kDeviceReturned);
    bench.run(0.6);
    EXPECT_EQ(bench.state.safety, arm_again ? SafetyState::kOn : SafetyState::kFault);
    if (arm_again) continue;
    bench.step(lose);
    EXPECT_EQ(bench.state.fault, FaultReason::kDeviceLost);
    arm(bench.state);
    bench.run(0.6);
    EXPECT_EQ(bench.state.safety, SafetyState::kOn);
  }
}

TEST_P(Rates, NothingElseArmsAgainByItself) {
  Bench bench = Bench::on(GetParam());
  bench.settings.arm_again = true;
  bench.step([](Seen& s) { s.sample.position.y() = kNaN; });
  bench.run(2);
  EXPECT_EQ(bench.state.fault, FaultReason::kBadPosition);
}

TEST_P(Rates, TheDeadManLetsGoAtOnceAndHoldingRampsUp) {
  const std::map<DeadMan, std::function<void(Seen&)>> switches{
      {DeadMan::kButton, [](Seen& s) { s.sample.buttons = 2; }},
      {DeadMan::kHeld, [](Seen& s) { s.sample.held = false; }}};
  for (const auto& [kind, let_go] : switches) {
    Bench bench = Bench::on(GetParam());
    bench.settings.dead_man = kind;
    bench.step();
    EXPECT_EQ(bench.state.safety, SafetyState::kOn);
    EXPECT_EQ(bench.step(let_go).force_N, Vec3(Vec3::Zero()));
    EXPECT_EQ(bench.state.safety, SafetyState::kWaiting);
    EXPECT_LT(bench.step().force_N.norm(), 2.1 * bench.settings.period_s / bench.settings.ramp_s);
    EXPECT_EQ(bench.state.safety, SafetyState::kArming);
    bench.run(0.6);
    EXPECT_EQ(bench.state.safety, SafetyState::kOn);
    EXPECT_EQ(bench.state.fault, FaultReason::kNone);
    bench.step(let_go);
    bench.step([](Seen& s) { s.sample.status = DeviceStatus::kLost; });
    EXPECT_EQ(bench.state.safety, SafetyState::kFault);
  }
}

TEST(Safety, ArmingInFaultOfADeviceThatIsStillAwayFaultsAgain) {
  Bench bench = Bench::on(1000);
  const auto lose = [](Seen& s) { s.sample.status = DeviceStatus::kLost; };
  bench.step(lose);
  arm(bench.state);
  EXPECT_EQ(bench.step(lose).safety, SafetyState::kFault);
}

TEST(Safety, AFaultFromElsewhereCountsOnlyWhenArmed) {
  ServoState off;
  fail(off, FaultReason::kStalled);
  EXPECT_EQ(off.safety, SafetyState::kOff);
  Bench bench = Bench::on(1000);
  fail(bench.state, FaultReason::kStalled);
  EXPECT_EQ(bench.step().force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(bench.state.fault, FaultReason::kStalled);
}

// The command that stops a device with another is a fault like any other: zero force in the same step, and again only
// when it is armed.
TEST(Safety, StopsWithAnotherDeviceUntilItIsArmed) {
  Bench bench = Bench::on(1000);
  apply(bench.state, ServoCommand::kJoin);
  EXPECT_EQ(bench.step().force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(bench.state.fault, FaultReason::kOtherDevice);
  for (int i = 0; i < 2000; ++i) EXPECT_EQ(bench.step().safety, SafetyState::kFault);
  apply(bench.state, ServoCommand::kArm);
  EXPECT_EQ(bench.step().safety, SafetyState::kArming);
}

TEST(Watchdog, BarksOnceForEachStall) {
  Watchdog dog(20);
  for (std::uint64_t steps = 1; steps < 100; ++steps) EXPECT_FALSE(dog.look(steps));
  for (int stall = 0; stall < 3; ++stall) {
    const auto steps = static_cast<std::uint64_t>(200 + stall);
    EXPECT_FALSE(dog.look(steps));
    for (int look = 1; look < 20; ++look) EXPECT_FALSE(dog.look(steps)) << look;
    EXPECT_TRUE(dog.look(steps));
    for (int look = 0; look < 100; ++look) EXPECT_FALSE(dog.look(steps));
  }
}

// The servo thread hangs with a force on; stop() from another thread, and the motors are without current.
TEST(Watchdog, AServoThatNeverBeginsStandsStill) {
  Watchdog dog(20);
  for (int look = 1; look < 20; ++look) EXPECT_FALSE(dog.look(0)) << look;
  EXPECT_TRUE(dog.look(0));
  EXPECT_FALSE(dog.look(1));
}

TEST(Watchdog, TheSimulatedDeviceStopsOutsideTheServosCalls) {
  SimulatedDevice device;
  device.read(0);
  device.write(Vec3(0, 3, 0));
  EXPECT_GT(device.arm().motorForce_N().norm(), 2.5);
  device.stop();
  device.read(1'000'000);
  EXPECT_LT(device.arm().motorForce_N().norm(), 1e-3);
  device.write(Vec3(0, 3, 0));
  EXPECT_GT(device.arm().motorForce_N().norm(), 2.5);
}

}  // namespace
}  // namespace hl::test_safety
