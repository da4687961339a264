// Servo step: the PD law, the safety states and their faults, the clamps under any input.
#include "control/servo.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "guard/realtime_guard.h"

namespace hl::test_servo {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ServoSettings settingsForTests() {
  ServoSettings settings;
  settings.stiffness_N_m = 1000;
  settings.damping_Ns_m = 2;
  settings.force_limit_N = 8;
  settings.force_rate_limit_N_s = 2000;
  settings.velocity_limit_m_s = 1;
  return settings;
}

/// A servo with its clock; every step says what the device and the proxy say.
struct Bench {
  ServoSettings settings = settingsForTests();
  ServoState state;
  std::int64_t now_ns = 1'000'000'000;

  ServoOutput step(const Vec3& target, const Vec3& finger, std::int64_t target_age_ns = 0,
                   DeviceStatus status = DeviceStatus::kOk) {
    now_ns += kPeriod_ns;
    return stepServo(state, settings, {target, now_ns - target_age_ns, true}, {now_ns, finger, 0, status});
  }
  /// Armed, ramp done, finger and target at the origin.
  static Bench on() {
    Bench bench;
    arm(bench.state);
    for (int i = 0; i < 501; ++i) bench.step(Vec3::Zero(), Vec3::Zero());
    return bench;
  }
};

TEST(Servo, OffGivesNoForce) {
  Bench bench;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(bench.step({0.01, 0, 0}, Vec3::Zero()).force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(bench.state.safety, SafetyState::kOff);
}

TEST(Servo, ArmingRampsTheForceFromZeroThenIsOn) {
  Bench bench;
  arm(bench.state);
  double before_N = 0;
  for (int i = 1; i <= 500; ++i) {
    const ServoOutput out = bench.step({0.002, 0, 0}, Vec3::Zero());
    EXPECT_NEAR(out.force_N.x(), 2.0 * i / 500, 1e-9);
    EXPECT_GT(out.force_N.x(), before_N);
    EXPECT_EQ(out.safety, i < 499 ? SafetyState::kArming : out.safety);
    before_N = out.force_N.x();
  }
  EXPECT_EQ(bench.step({0.002, 0, 0}, Vec3::Zero()).safety, SafetyState::kOn);
}

TEST(Servo, ForceIsSpringLessDampingInContact) {
  Bench bench = Bench::on();
  Vec3 finger = Vec3::Zero();
  ServoOutput out;
  for (int i = 0; i < 500; ++i) {
    finger.y() += 1e-4;  // 0.1 m/s
    out = bench.step(finger + Vec3(0.001, 0, 0), finger);
  }
  EXPECT_NEAR(out.force_N.x(), 1.0, 1e-9);
  EXPECT_NEAR(out.force_N.y(), -0.2, 1e-6);
}

TEST(Servo, FreeAirHasNoDrag) {
  Bench bench = Bench::on();
  Vec3 finger = Vec3::Zero();
  for (int i = 0; i < 500; ++i) {
    finger += Vec3(3e-4, -2e-4, 1e-4);
    EXPECT_EQ(bench.step(finger, finger).force_N, Vec3(Vec3::Zero()));
  }
}

// Where nothing is touched too; limited as any force, and none when the tick that found it is old.
TEST(Servo, TheFieldsOfTheSceneAddToTheForce) {
  Bench bench = Bench::on();
  const auto step = [&](const Vec3& field_N, double drag_Ns_m, std::int64_t age_ns, const Vec3& finger) {
    bench.now_ns += kPeriod_ns;
    ServoTarget target;
    target.time_ns = bench.now_ns - age_ns;
    target.field_N = field_N;
    target.field_drag_Ns_m = drag_Ns_m;
    return stepServo(bench.state, bench.settings, target, {bench.now_ns, finger, 0, DeviceStatus::kOk}).force_N;
  };
  EXPECT_EQ(step({1, 0, 0}, 0, 0, Vec3::Zero()), Vec3(1, 0, 0));
  EXPECT_EQ(step({2, 0, 0}, 0, 0, Vec3::Zero()), Vec3(2, 0, 0));
  EXPECT_EQ(step({0, 0, 0}, 0, 0, Vec3::Zero()), Vec3(Vec3::Zero()));
  for (int i = 0; i < 100; ++i) EXPECT_LE(step({1000, 0, 0}, 0, 0, Vec3::Zero()).norm(), 8 + 1e-12);
  for (int i = 0; i < 100; ++i) step({1, 0, 0}, 0, bench.settings.target_stale_ns + 1, Vec3::Zero());
  EXPECT_EQ(bench.state.force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(step({kNaN, 0, 0}, 0, 0, Vec3::Zero()), Vec3(Vec3::Zero()));
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < 200; ++i) force = step(Vec3::Zero(), 5, 0, {1e-4 * i, 0, 0});
  EXPECT_NEAR(force.x(), -5 * 0.1, 1e-3);
}

TEST(Servo, DisarmGivesNoForceFromTheNextStepOn) {
  Bench bench = Bench::on();
  EXPECT_GT(bench.step({0.002, 0, 0}, Vec3::Zero()).force_N.norm(), 1);
  disarm(bench.state);
  EXPECT_EQ(bench.step({0.002, 0, 0}, Vec3::Zero()).force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(bench.state.safety, SafetyState::kOff);
}

void expectFault(Bench& bench, const ServoOutput& out, FaultReason reason) {
  EXPECT_EQ(out.safety, SafetyState::kFault);
  EXPECT_EQ(out.fault, reason);
  EXPECT_EQ(out.force_N, Vec3(Vec3::Zero()));
  EXPECT_STRNE(faultText(reason), "");
  // It stays so until armed again, and then starts from zero.
  EXPECT_EQ(bench.step({0.002, 0, 0}, Vec3::Zero()).safety, SafetyState::kFault);
  arm(bench.state);
  const ServoOutput again = bench.step({0.002, 0, 0}, Vec3::Zero());
  EXPECT_EQ(again.safety, SafetyState::kArming);
  EXPECT_EQ(again.fault, FaultReason::kNone);
  EXPECT_LT(again.force_N.norm(), 0.01);
}

TEST(Servo, LostOrUnreadyDeviceIsAFault) {
  Bench lost = Bench::on();
  expectFault(lost, lost.step({0.002, 0, 0}, Vec3::Zero(), 0, DeviceStatus::kLost), FaultReason::kDeviceLost);
  Bench unready = Bench::on();
  expectFault(unready, unready.step({0.002, 0, 0}, Vec3::Zero(), 0, DeviceStatus::kNotReady), FaultReason::kNotReady);
}

TEST(Servo, PositionThatIsNoNumberIsAFault) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    Bench bench = Bench::on();
    expectFault(bench, bench.step({0.002, 0, 0}, {0, bad, 0}), FaultReason::kBadPosition);
  }
}

TEST(Servo, FingerFasterThanTheLimitIsAFault) {
  Bench bench = Bench::on();
  ServoOutput out;
  for (int i = 1; i <= 20; ++i) out = bench.step(Vec3::Zero(), {0.0015 * i, 0, 0});  // 1.5 m/s
  expectFault(bench, out, FaultReason::kTooFast);
  Bench jumped = Bench::on();
  expectFault(jumped, jumped.step(Vec3::Zero(), {1e308, 1e308, 0}), FaultReason::kTooFast);
}

TEST(Servo, TargetThatIsNoNumberInvalidOrStaleGivesNoForce) {
  for (const double bad : {kNaN, kInfinity}) {
    Bench bench = Bench::on();
    bench.step({0.001, 0, 0}, Vec3::Zero());
    EXPECT_EQ(bench.step({bad, 0, 0}, Vec3::Zero()).force_N, Vec3(Vec3::Zero()));
  }
  Bench stale = Bench::on();
  stale.step({0.001, 0, 0}, Vec3::Zero());
  EXPECT_EQ(stale.step({0.001, 0, 0}, Vec3::Zero(), 51'000'000).force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(stale.state.safety, SafetyState::kOn);
  Bench invalid = Bench::on();
  invalid.now_ns += kPeriod_ns;
  const ServoTarget none{{0.001, 0, 0}, invalid.now_ns, false};
  const DeviceSample sample{invalid.now_ns, Vec3::Zero(), 0, DeviceStatus::kOk};
  EXPECT_EQ(stepServo(invalid.state, invalid.settings, none, sample).force_N, Vec3(Vec3::Zero()));
}

TEST(Servo, TargetStaleForLongIsAFault) {
  Bench bench = Bench::on();
  const ServoOutput out = bench.step({0.002, 0, 0}, Vec3::Zero(), bench.settings.target_lost_ns + 1'000'000);
  expectFault(bench, out, FaultReason::kStaleTarget);
}

TEST(Servo, TooManyMissedDeadlinesAreAFaultAndAFewAreNot) {
  Bench few = Bench::on();
  for (int i = 0; i < 2000; ++i) {
    if (i % 20 == 0) few.now_ns += kPeriod_ns;  // every twentieth period missed
    EXPECT_EQ(few.step(Vec3::Zero(), Vec3::Zero()).safety, SafetyState::kOn);
  }
  Bench many = Bench::on();
  ServoOutput out;
  for (int i = 0; i < 600 && out.fault == FaultReason::kNone; ++i) {
    many.now_ns += kPeriod_ns;  // every second one
    out = many.step(Vec3::Zero(), Vec3::Zero());
  }
  expectFault(many, out, FaultReason::kDeadlines);
}

/// Numbers of every size, NaN and infinity among them.
double anyNumber(std::mt19937& random) {
  static constexpr std::array kOdd{kNaN, kInfinity, -kInfinity, 0.0, 1e308, -1e308, 5e-324};
  const unsigned kind = random() % 64;
  if (kind < kOdd.size()) return kOdd[kind];
  return std::uniform_real_distribution<>(-1, 1)(random) * (kind < 12 ? 10 : 0.02);
}

TEST(Servo, MillionStepsOfAnythingKeepForceAndItsRateWithinLimits) {
  std::mt19937 random(7);
  Bench bench = Bench::on();
  const double change_max_N = bench.settings.force_rate_limit_N_s * bench.settings.period_s;
  Vec3 before = Vec3::Zero(), finger = Vec3::Zero();
  int forced = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    if (bench.state.safety == SafetyState::kFault || random() % 5000 == 0) arm(bench.state);
    if (bench.state.safety == SafetyState::kArming && random() % 4 == 0) bench.state.ramp = 1;
    const bool tame = random() % 64 != 0;
    if (tame) finger = Vec3::Random() * 1e-4;
    const Vec3 read = tame ? finger : Vec3(anyNumber(random), anyNumber(random), anyNumber(random));
    const Vec3 target(anyNumber(random), anyNumber(random), anyNumber(random));
    bench.now_ns += static_cast<std::int64_t>(random() % 3'000'000) - 500'000;
    const ServoTarget wanted{target, bench.now_ns - static_cast<std::int64_t>(random() % 60'000'000),
                             random() % 16 != 0};
    const DeviceStatus status = random() % 1000 == 0 ? DeviceStatus::kLost : DeviceStatus::kOk;
    const bool restarted = bench.state.force_N.isZero(0);
    const ServoOutput out = stepServo(bench.state, bench.settings, wanted, {bench.now_ns, read, 0, status});
    ASSERT_TRUE(out.force_N.allFinite()) << i;
    ASSERT_LE(out.force_N.norm(), bench.settings.force_limit_N * (1 + 1e-12)) << i;
    const Vec3 from = restarted ? Vec3(Vec3::Zero()) : before;  // arm() and faults go to zero at once
    if (!out.force_N.isZero(0)) {
      ASSERT_LE((out.force_N - from).norm(), change_max_N * (1 + 1e-9)) << i;
      ++forced;
    }
    before = out.force_N;
  }
  EXPECT_GT(forced, 10'000);
}

TEST(Servo, ArmingAgainWhileOnChangesNothing) {
  Bench bench = Bench::on();
  const Vec3 before = bench.step({0.001, 0, 0}, Vec3::Zero()).force_N;
  arm(bench.state);
  EXPECT_EQ(bench.state.safety, SafetyState::kOn);
  EXPECT_EQ(bench.state.force_N, before);
}

TEST(Servo, StepDoesNotAllocate) {
  Bench bench = Bench::on();
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) bench.step({0.001, 0, 0}, Vec3::Zero());
}

TEST(Servo, SettingsComeFromTheDevice) {
  DeviceInfo info;
  info.stiffness_N_m = 700;
  info.damping_Ns_m = 4;
  info.force_max_N = 3.3;
  info.force_rate_max_N_s = 5000;
  info.velocity_max_m_s = 2;
  info.servo_rate_Hz = 2000;
  const ServoSettings settings = ServoSettings::of(info);
  EXPECT_EQ(settings.stiffness_N_m, 700);
  EXPECT_EQ(settings.damping_Ns_m, 4);
  EXPECT_EQ(settings.force_limit_N, 3.3);
  EXPECT_EQ(settings.force_rate_limit_N_s, 5000);
  EXPECT_EQ(settings.velocity_limit_m_s, 2);
  EXPECT_EQ(settings.period_s, 5e-4);
}

}  // namespace
}  // namespace hl::test_servo
