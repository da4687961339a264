// What reaches the device when things break, on the real clock, with a device that can be broken.
#include "touch/servo_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "record/recorder.h"
#include "record/replay.h"
#include "temp_folder.h"
#include "touch/touch_session.h"

namespace hl::test_servo_watch {
namespace {

/// It does not move.
class StillHand final : public SimulatedHand {
 public:
  void setHandGoal(const Vec3&) override {}
  void setHandFirm(bool) override {}
  void setHandHolds(bool) override {}
  void setHandButtons(std::uint32_t) override {}
  void setHandTurn(const Eigen::Quaterniond&) override {}
  void setHandGripper(double) override {}
};

/// A device that stands at the origin, and hangs, is slow, lost or let go when set to.
class BreakableDevice final : public Device {
 public:
  explicit BreakableDevice(SimulatedHand* hand) : hand_(hand) {
    info_.name = "breakable";
    info_.workspace_min = Vec3::Constant(-0.1);
    info_.workspace_max = Vec3::Constant(0.1);
    info_.force_max_N = 5;
    info_.force_rate_max_N_s = 10'000;
    info_.stiffness_N_m = 1000;
    info_.stiffness_max_N_m = 1000;
    info_.velocity_max_m_s = 3;
  }
  void open() override {}
  void close() override {}
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override {
    while (hangs) std::this_thread::yield();
    if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    DeviceSample sample;
    sample.time_ns = now_ns;
    sample.status = lost ? DeviceStatus::kLost : DeviceStatus::kOk;
    sample.held = held;
    return sample;
  }
  SimulatedHand* hand() override { return hand_; }
  void write(const Vec3& force_N) override { force = force_N.norm(); }
  void stop() noexcept override {
    force = 0;
    ++stops;
  }

  std::atomic<bool> hangs{false}, slow{false}, lost{false}, held{true};
  std::atomic<double> force{0};
  std::atomic<int> stops{0};

 private:
  DeviceInfo info_;
  SimulatedHand* const hand_;
};

void waitUntil(const std::function<bool()>& holds) {
  while (!holds()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// A session in an empty scene whose servo makes a constant force of 1 N.
struct Bench {
  StillHand hand;
  BreakableDevice* device;
  std::unique_ptr<TouchSession> session;

  explicit Bench(TouchSettings settings = {}, bool simulated = false) {
    settings.servo.effects.constant_N = Vec3(1, 0, 0);
    auto own = std::make_unique<BreakableDevice>(simulated ? &hand : nullptr);
    device = own.get();
    session = std::make_unique<TouchSession>(makeSnapshot(std::vector<Instance>{}), settings, std::move(own));
    session->start();
    waitFor(SafetyState::kOn);
  }
  ServoView view() const {
    ServoView servo;
    ProxyView proxy;
    session->views(servo, proxy);
    return servo;
  }
  // Ticks so far that have been counted by why they ended.
  std::uint64_t endings() const {
    ServoView servo;
    ProxyView proxy;
    session->views(servo, proxy);
    std::uint64_t sum = 0;
    proxy.ended.each([&](Ending, std::uint64_t count) { sum += count; });
    return sum;
  }
  // A machine that is too busy may hold up the servo on its own account: then it is armed anew.
  void waitFor(SafetyState state) const {
    waitUntil([&] {
      const ServoView now = view();
      if (now.fault == FaultReason::kStalled || now.fault == FaultReason::kDeadlines) session->live().rearm();
      return now.safety == state;
    });
  }
};

TEST(ServoWatch, ADriverThatHangsIsStoppedFromOutsideAndTheServoFindsItselfInFault) {
  Bench bench;
  waitUntil([&] { return bench.device->force == 1; });
  const int stops = bench.device->stops;
  bench.device->hangs = true;
  waitUntil([&] { return bench.device->stops > stops; });
  EXPECT_EQ(bench.device->force, 0);
  waitUntil([&] { return bench.view().fault == FaultReason::kStalled; });
  EXPECT_EQ(bench.view().safety, SafetyState::kFault);
  EXPECT_EQ(bench.view().force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(bench.device->stops, stops + 1);
  bench.device->hangs = false;
  const std::uint64_t steps = bench.session->servoTotals().steps;
  waitUntil([&] { return bench.session->servoTotals().steps > steps + 100; });
  EXPECT_EQ(bench.view().fault, FaultReason::kStalled);
  EXPECT_EQ(bench.device->force, 0);
  bench.session->live().rearm();
  bench.waitFor(SafetyState::kOn);
  waitUntil([&] { return bench.device->force == 1; });
}

// No step comes any more, and still there is a file of those before.
TEST(ServoWatch, AStallLeavesABlackBoxWhileItLasts) {
  const test::TempFolder folder;
  std::atomic<bool> reported{false};
  TouchSettings settings;
  RecorderSettings recorder;
  recorder.black_box_folder = folder.path().string();
  recorder.report = [&](const std::string&, const std::string&) { reported = true; };
  settings.sink = recorderWith(recorder);
  Bench bench(settings);
  bench.device->hangs = true;
  waitUntil([&] { return reported.load(); });
  const auto box = std::filesystem::directory_iterator(folder.path())->path();
  const ReplayReport report = replay(box.string());
  EXPECT_EQ(report.fault, faultText(FaultReason::kStalled));
  EXPECT_FALSE(report.difference);
  EXPECT_GT(report.steps, 100u);
  bench.device->hangs = false;
}

TEST(ServoWatch, ALostDeviceThatReturnsIsReportedAndArmsAgainWhereItIsWanted) {
  for (const bool arm_again : {false, true}) {
    TouchSettings settings;
    settings.servo.arm_again = arm_again;
    Bench bench(settings);
    bench.device->lost = true;
    waitUntil([&] { return bench.view().fault == FaultReason::kDeviceLost; });
    EXPECT_EQ(bench.device->force, 0);
    bench.device->lost = false;
    if (!arm_again) {
      waitUntil([&] { return bench.view().fault == FaultReason::kDeviceReturned; });
      bench.session->live().rearm();
    }
    bench.waitFor(SafetyState::kOn);
  }
}

TEST(ServoWatch, WhileTheDeviceIsLostNoTickEnds) {
  Bench bench;
  EXPECT_GT(bench.endings(), 0U);
  bench.device->lost = true;
  waitUntil([&] { return bench.view().fault == FaultReason::kDeviceLost; });
  const auto waitForSteps = [&](std::uint64_t steps) {
    const std::uint64_t before = bench.session->servoTotals().steps;
    waitUntil([&] { return bench.session->servoTotals().steps > before + steps; });
  };
  waitForSteps(10);  // the steps that were under way
  const std::uint64_t endings = bench.endings();
  waitForSteps(100);
  EXPECT_EQ(bench.endings(), endings);
  bench.device->lost = false;
  waitUntil([&] { return bench.endings() > endings; });
}

TEST(ServoWatch, AServoThatIsLateTooOftenIsAFaultWhereAPersonHoldsTheDevice) {
  Bench bench;
  bench.device->slow = true;
  waitUntil([&] { return bench.view().fault == FaultReason::kDeadlines; });
  EXPECT_EQ(bench.view().safety, SafetyState::kFault);
  EXPECT_EQ(bench.device->force, 0);
}

TEST(ServoWatch, ASimulatedHandGoesOnHoweverLateTheServoIs) {
  Bench bench({}, true);
  bench.device->slow = true;
  waitUntil([&] {
    EXPECT_NE(bench.view().fault, FaultReason::kDeadlines);
    return bench.session->servoTotals().missed > 1000;
  });
  bench.device->slow = false;
  bench.waitFor(SafetyState::kOn);
}

TEST(ServoWatch, ALetGoDeadManWaitsWithoutForce) {
  TouchSettings settings;
  settings.servo.dead_man = DeadMan::kHeld;
  Bench bench(settings);
  bench.device->held = false;
  bench.waitFor(SafetyState::kWaiting);
  EXPECT_EQ(bench.device->force, 0);
  bench.device->held = true;
  bench.waitFor(SafetyState::kOn);
}

TEST(ServoWatch, LooksLongerWhereTheMachineOrTheServoIsSlow) {
  EXPECT_EQ(ServoWatch::looks(true, 1000), 50u);
  EXPECT_EQ(ServoWatch::looks(false, 1000), 250u);
  EXPECT_EQ(ServoWatch::looks(true, 100), 100u);
}

}  // namespace
}  // namespace hl::test_servo_watch
