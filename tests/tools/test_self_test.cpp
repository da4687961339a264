// The self-test passes what works, and names what does not, on a virtual clock.
#include "tools/self_test.h"

#include <gtest/gtest.h>

#include <functional>

#include "device/simulated_device.h"

namespace hl::test_self_test {
namespace {

constexpr double kPeriod_s = 1e-3;

/// What goes wrong between servo and device.
struct Wiring {
  std::function<Vec3(const Vec3&)> force = [](const Vec3& force_N) { return force_N; };
  std::function<void(DeviceSample&, double time_s)> sample = [](DeviceSample&, double) {};
};

struct Outcome {
  SelfTestReport report;
  double lasted_s = 0;
  double strongest_N = 0, strongest_before_pulls_N = 0;
};

Outcome test(const DeviceModel& model, const Wiring& wiring = {}) {
  SimulatedDeviceSettings settings;
  settings.model = model;
  settings.step_s = 1e-4;
  SimulatedDevice device(settings);
  SelfTest test(device.info(), kPeriod_s);
  Outcome outcome;
  while (test.part() != SelfTestPart::kDone) {
    DeviceSample sample = device.read(static_cast<std::int64_t>(1e9 * outcome.lasted_s));
    wiring.sample(sample, outcome.lasted_s);
    const bool pulls = test.part() == SelfTestPart::kPull;
    const Vec3 force_N = test.step(sample);
    outcome.strongest_N = std::max(outcome.strongest_N, force_N.norm());
    if (!pulls) outcome.strongest_before_pulls_N = std::max(outcome.strongest_before_pulls_N, force_N.norm());
    device.write(wiring.force(force_N));
    device.setHandGoal(test.handGoal_D());
    outcome.lasted_s += kPeriod_s;
  }
  outcome.report = test.report();
  return outcome;
}

std::string firstFaultOf(const Outcome& outcome) {
  const auto faults = faultsOf(outcome.report);
  return faults.empty() ? "" : faults.front();
}

TEST(SelfTest, EverySimulatedDevicePassesWithin20s) {
  for (const char* name : {"premium1.5", "premium1.0", "touch", "falcon", "omega3"}) {
    const Outcome outcome = test(deviceModel(name));
    EXPECT_EQ(firstFaultOf(outcome), "") << name;
    EXPECT_NEAR(outcome.lasted_s, 20, 0.1);
    EXPECT_EQ(outcome.strongest_before_pulls_N, 0);
    EXPECT_LE(outcome.strongest_N, outcome.report.pull_N + 1e-12);
  }
}

TEST(SelfTest, ForcesTheOtherWayAreFound) {
  Wiring wiring;
  wiring.force = [](const Vec3& force_N) -> Vec3 { return force_N.cwiseProduct(Vec3(1, -1, 1)); };
  const Outcome outcome = test(premium15(), wiring);
  EXPECT_EQ(faultsOf(outcome.report).size(), 2U);
  EXPECT_NE(firstFaultOf(outcome).find("+y (up): the tip went the other way"), std::string::npos);
}

TEST(SelfTest, ExchangedAxesAreFound) {
  Wiring wiring;
  wiring.force = [](const Vec3& force_N) { return Vec3(force_N.y(), force_N.x(), force_N.z()); };
  const Outcome outcome = test(premium15(), wiring);
  EXPECT_EQ(faultsOf(outcome.report).size(), 4U);
  EXPECT_NE(firstFaultOf(outcome).find("went across it"), std::string::npos);
}

TEST(SelfTest, MotorsWithoutPowerAreFound) {
  Wiring wiring;
  wiring.force = [](const Vec3&) { return Vec3(Vec3::Zero()); };
  EXPECT_NE(firstFaultOf(test(premium15(), wiring)).find("the tip did not move"), std::string::npos);
}

TEST(SelfTest, APositionThatStaysIsNotCalibrated) {
  Wiring wiring;
  wiring.sample = [](DeviceSample& sample, double) { sample.position = Vec3(0.01, 0, 0); };
  const auto faults = faultsOf(test(premium15(), wiring).report);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("not calibrated"), std::string::npos);
}

TEST(SelfTest, AnAxisThatWasNotMovedIsNamed) {
  Wiring wiring;
  wiring.sample = [](DeviceSample& sample, double) { sample.position.z() = 0; };
  EXPECT_NE(firstFaultOf(test(premium15(), wiring)).find("along z (toward you): move it further"), std::string::npos);
}

TEST(SelfTest, ADeviceThatIsLostEndsItAtOnce) {
  Wiring wiring;
  wiring.sample = [](DeviceSample& sample, double time_s) {
    if (time_s > 12) sample.status = DeviceStatus::kLost;
  };
  const Outcome outcome = test(premium15(), wiring);
  EXPECT_NEAR(outcome.lasted_s, 12, 0.01);
  EXPECT_EQ(outcome.report.fault, FaultReason::kDeviceLost);
  EXPECT_NE(firstFaultOf(outcome).find("it ended in a fault"), std::string::npos);
}

TEST(SelfTest, OldPositionsAreFound) {
  Wiring wiring;
  wiring.sample = [](DeviceSample& sample, double) { sample.age_ns = 30'000'000; };
  EXPECT_NE(firstFaultOf(test(premium15(), wiring)).find("30 ms old"), std::string::npos);
}

}  // namespace
}  // namespace hl::test_self_test
