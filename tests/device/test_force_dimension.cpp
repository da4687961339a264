// What only Force Dimension's devices do: forces that they switch off, calibration, watchdog.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "device/fakes/fake_arm.h"
#include "device/force_dimension/figures.h"
#include "device/force_dimension/force_dimension_device.h"

namespace hl::test::test_force_dimension {
namespace {

class ForceDimension : public testing::Test {
 protected:
  void SetUp() override {
    setenv("HL_DHD_LIBRARY", HL_FAKE_DHD, 1);
    fake_ = dlopen(HL_FAKE_DHD, RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(fake_, nullptr) << dlerror();
    arm_ = reinterpret_cast<FakeArmOf*>(dlsym(fake_, kFakeArmOf))();
    arm_->useVirtualClock();
    device_.open();
  }
  void TearDown() override {
    device_.close();
    dlclose(fake_);
  }
  DeviceStatus step(const Vec3& force_N) {
    arm_->advance(1e-3);
    const DeviceSample sample = device_.read(arm_->now_ns());
    device_.write(force_N);
    return sample.status;
  }
  int watchdog() const { return reinterpret_cast<int (*)()>(dlsym(fake_, "hlFakeWatchdog"))(); }
  void switchForcesOff(int cause) const { reinterpret_cast<void (*)(int)>(dlsym(fake_, "hlFakeForcesOff"))(cause); }
  // The statuses of the next 300 ms, the same ones in a row given once.
  std::vector<DeviceStatus> statuses() {
    std::vector<DeviceStatus> seen;
    for (int i = 0; i < 300; ++i) {
      const DeviceStatus status = step(Vec3::Zero());
      if (seen.empty() || seen.back() != status) seen.push_back(status);
    }
    return seen;
  }

  void* fake_ = nullptr;
  FakeArm* arm_ = nullptr;
  ForceDimensionDevice device_;
};

using Statuses = std::vector<DeviceStatus>;

TEST_F(ForceDimension, WatchdogRunsFromTheFirstForceToTheEnd) {
  EXPECT_EQ(watchdog(), 0);
  step(Vec3::Zero());
  EXPECT_EQ(watchdog(), 160);  // of 125 us
  device_.close();
  EXPECT_EQ(watchdog(), 0);
}

TEST_F(ForceDimension, ForcesThatItSwitchesOffAreReportedAndComeBack) {
  for (const int cause : {2, 3}) {  // velocity, watchdog
    ASSERT_EQ(step(Vec3::Zero()), DeviceStatus::kOk);
    switchForcesOff(cause);
    EXPECT_EQ(statuses(), (Statuses{DeviceStatus::kOk, DeviceStatus::kNotReady, DeviceStatus::kOk})) << cause;
  }
}

TEST_F(ForceDimension, ForcesThatAPersonSwitchesOffStayOff) {
  for (const int cause : {1, 6}) {  // button, dead man
    switchForcesOff(cause);
    statuses();
    EXPECT_EQ(statuses(), (Statuses{DeviceStatus::kNotReady})) << cause;
  }
}

TEST_F(ForceDimension, IsNotReadyBeforeItIsCalibrated) {
  arm_->not_ready = true;
  EXPECT_EQ(statuses().back(), DeviceStatus::kNotReady);
  arm_->not_ready = false;
  EXPECT_EQ(statuses().back(), DeviceStatus::kOk);
}

TEST_F(ForceDimension, HasTheFiguresOfItsType) {
  EXPECT_EQ(device_.info().name, "Force Dimension omega.3");
  EXPECT_EQ(device_.info().force_max_N, 12);
  EXPECT_EQ(forceDimensionFigures(63).force_max_N, 20);
  EXPECT_EQ(forceDimensionFigures(108).stiffness_max_N_m, 8000);
  EXPECT_EQ(forceDimensionFigures(-1).force_max_N, 8);  // the weakest
}

}  // namespace
}  // namespace hl::test::test_force_dimension
