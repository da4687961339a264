// The contract of a device, for every driver, each against a fake that speaks its language.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <limits>
#include <random>
#include <thread>

#include "base/error.h"
#include "device/fakes/bench.h"
#include "device/open_device.h"
#include "device/simulated_hand.h"
#include "guard/realtime_guard.h"

namespace hl::test::test_drivers {
namespace {

class DeviceContract : public testing::TestWithParam<BenchKind> {
 protected:
  void SetUp() override {
    bench_ = GetParam().make();
    bench_->arm().useVirtualClock();
    device_ = bench_->device();
  }

  // One servo step of 1 ms that holds `force_N`.
  DeviceSample step(const Vec3& force_N = Vec3::Zero()) {
    bench_->arm().advance(1e-3);
    const RealtimeGuard guard;  // it is a part of the servo step
    const DeviceSample sample = device_->read(bench_->arm().now_ns());
    device_->write(force_N);
    return sample;
  }
  // Steps until `done`; drivers with threads of their own answer when they can.
  template <typename Done>
  DeviceSample until(const Done& done, const Vec3& force_N = Vec3::Zero()) {
    while (true) {
      const DeviceSample sample = step(force_N);
      if (done(sample)) return sample;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
  DeviceSample untilStatus(DeviceStatus status) {
    return until([status](const DeviceSample& sample) { return sample.status == status; });
  }
  void openAndWait() {
    device_->open();
    untilStatus(DeviceStatus::kOk);
  }
  // The arm as it is when a hand has held it still for a while.
  void settle() {
    for (int i = 0; i < 1500; ++i) bench_->arm().advance(1e-3);
  }
  bool agrees(const DeviceSample& sample) const {
    return (sample.position - bench_->arm().trueTip_D()).norm() <= GetParam().position_tolerance_m;
  }

  std::unique_ptr<Bench> bench_;
  std::unique_ptr<Device> device_;
};

TEST_P(DeviceContract, TheStylusIsTurnedInDAsTheHandTurnsIt) {
  if (device_->hand() != nullptr) return;  // a simulated one: test_stylus.cpp
  openAndWait();
  std::mt19937 random(1);
  std::normal_distribution<> normal;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    bench_->arm().turn(turned);
    bench_->arm().gripper_rad = 0.01 * i;
    const bool has_wrist = device_->info().has_wrist, has_gripper = device_->info().gripper_max_rad > 0;
    const Eigen::Quaterniond expected = has_wrist ? turned : Eigen::Quaterniond::Identity();
    const DeviceSample sample = until([&](const DeviceSample& now) {
      return now.stylus.turned.angularDistance(expected) < 1e-7 && now.status == DeviceStatus::kOk;
    });
    EXPECT_LT(sample.stylus.turned.coeffs().cwiseAbs().squaredNorm() - 1, 1e-12);
    EXPECT_LT((sample.stylus.turned * expected.conjugate()).vec().norm(), 1e-12);
    EXPECT_EQ(sample.stylus.gripper_rad, has_gripper ? 0.01 * i : 0);
  }
}

TEST_P(DeviceContract, FiguresAreThoseOfADeviceThatCanBeServoed) {
  openAndWait();
  const DeviceInfo& info = device_->info();
  EXPECT_FALSE(info.name.empty());
  EXPECT_TRUE((info.workspace_max.array() > info.workspace_min.array()).all());
  EXPECT_GT(info.force_max_N, 0);
  EXPECT_GE(info.force_max_N, info.force_continuous_N);
  EXPECT_GT(info.force_continuous_N, 0);
  EXPECT_GT(info.force_rate_max_N_s, 0);
  EXPECT_GT(info.stiffness_N_m, 0);
  EXPECT_GE(info.stiffness_max_N_m, info.stiffness_N_m);
  EXPECT_GE(info.damping_Ns_m, 0);
  EXPECT_GT(info.velocity_max_m_s, 0);
  EXPECT_GE(info.servo_rate_Hz, 100);
}

TEST_P(DeviceContract, OpensAndClosesTwice) {
  EXPECT_EQ(device_->read(0).status == DeviceStatus::kOk, device_->hand() != nullptr);
  for (int round = 0; round < 2; ++round) {
    device_->open();
    openAndWait();
    device_->close();
    device_->close();
  }
}

TEST_P(DeviceContract, PositionIsTheTipsInFrameD) {
  openAndWait();
  for (const Vec3& goal : {Vec3(0.03, 0, 0), Vec3(0, 0.02, 0), Vec3(0, 0, 0.025), Vec3(-0.02, 0.01, -0.03)}) {
    bench_->arm().setHandGoal(goal);
    settle();
    const DeviceSample sample = until([this](const DeviceSample& s) { return agrees(s); });
    EXPECT_LT((sample.position - goal).norm(), 2e-3);  // the friction of the arm holds it back
  }
}

TEST_P(DeviceContract, ForceArrivesAtTheTipInFrameD) {
  openAndWait();
  for (const Vec3& force : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-0.5, 0.7, -0.4)}) {
    until([&](const DeviceSample&) { return (bench_->arm().force_D() - force).norm() < GetParam().force_tolerance_N; },
          force);
  }
}

TEST_P(DeviceContract, ForceThatIsNoNumberIsNone) {
  openAndWait();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Vec3& bad : {Vec3(nan, 0, 0), Vec3(1, infinity, 0), Vec3(0, 1, nan)}) {
    const Vec3 force(1, 0, 0);
    until([&](const DeviceSample&) { return (bench_->arm().force_D() - force).norm() < GetParam().force_tolerance_N; },
          force);
    until([&](const DeviceSample&) { return bench_->arm().force_D().norm() < 1e-12; }, bad);
  }
}

TEST_P(DeviceContract, NoForceIsLeftWhenItIsClosed) {
  openAndWait();
  until([&](const DeviceSample&) { return bench_->arm().force_D().norm() > 0.9; }, Vec3(0, 1, 0));
  device_->close();
  while (bench_->arm().force_D().norm() > 1e-12) std::this_thread::yield();
  EXPECT_EQ(device_->read(bench_->arm().now_ns()).status == DeviceStatus::kOk, device_->hand() != nullptr);
}

TEST_P(DeviceContract, ButtonsAreReported) {
  openAndWait();
  if (device_->hand() != nullptr) return;  // a simulated arm has none
  bench_->arm().buttons = 1;
  until([](const DeviceSample& sample) { return sample.buttons == 1; });
  bench_->arm().buttons = 0;
  until([](const DeviceSample& sample) { return sample.buttons == 0; });
}

TEST_P(DeviceContract, IsLostWhileItDoesNotAnswerAndComesBackWithoutForce) {
  openAndWait();
  if (device_->hand() != nullptr) return;  // a simulated arm is always there
  for (int round = 0; round < 2; ++round) {
    bench_->arm().lost = true;
    until([](const DeviceSample& sample) { return sample.status == DeviceStatus::kLost; }, Vec3(0, 1, 0));
    // A driver whose thread got no time is lost too, and may be about to send a frame with the old force: it finds
    // nobody.
    const auto sent = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    until([&](const DeviceSample&) { return std::chrono::steady_clock::now() > sent; });
    bench_->arm().lost = false;
    untilStatus(DeviceStatus::kOk);
    EXPECT_LT(bench_->arm().force_D().norm(), 1e-12);
    bench_->arm().setHandGoal(Vec3(0.01 * (round + 1), 0.01, 0));
    settle();
    until([this](const DeviceSample& sample) { return agrees(sample); });
  }
}

TEST_P(DeviceContract, ClosesWhileItIsLost) {
  openAndWait();
  if (device_->hand() != nullptr) return;
  bench_->arm().lost = true;
  untilStatus(DeviceStatus::kLost);
  device_->close();
}

INSTANTIATE_TEST_SUITE_P(Drivers, DeviceContract, testing::ValuesIn(benchKinds()),
                         [](const auto& of) { return of.param.name; });

// ---- What vendors' libraries have in common -------------------------------------------------------------------------

struct Vendor {
  const char* kind;
  const char* variable;
  const char* install;
};

class VendorLibraries : public testing::TestWithParam<Vendor> {};

TEST_P(VendorLibraries, MissingOnesAreALineThatSaysWhatToInstall) {
  setenv(GetParam().variable, "/nonexistent/libvendor.so", 1);
  const auto device = makeDevice(GetParam().kind);
  std::string why;
  try {
    device->open();
  } catch (const Error& error) {
    why = error.what();
  }
  EXPECT_NE(why.find(GetParam().install), std::string::npos) << why;
  EXPECT_NE(why.find(GetParam().variable), std::string::npos) << why;
  EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  EXPECT_EQ(device->read(0).status, DeviceStatus::kNotReady);
  device->write(Vec3(1, 0, 0));
  device->close();
  for (const DevicePresence& found : findDevices()) {
    EXPECT_EQ(found.text == why, found.kind == GetParam().kind) << found.kind << ": " << found.text << "\nnot\n" << why;
  }
  EXPECT_EQ(openDevice("sim")->read(0).status, DeviceStatus::kOk);
}

INSTANTIATE_TEST_SUITE_P(Drivers, VendorLibraries,
                         testing::Values(Vendor{"dhd", "HL_DHD_LIBRARY", "Force Dimension SDK"},
                                         Vendor{"hd", "HL_HD_LIBRARY", "OpenHaptics"}),
                         [](const auto& of) { return of.param.kind; });

}  // namespace
}  // namespace hl::test::test_drivers
