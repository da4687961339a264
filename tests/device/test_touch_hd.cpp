// What only OpenHaptics does: calibration while it runs, errors that matter and those that do not, its figures.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "device/fakes/fake_arm.h"
#include "device/touch_hd/touch_hd_device.h"

namespace hl::test::test_touch_hd {
namespace {

class TouchHd : public testing::Test {
 protected:
  void SetUp() override {
    setenv("HL_HD_LIBRARY", HL_FAKE_HD, 1);
    fake_ = dlopen(HL_FAKE_HD, RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(fake_, nullptr) << dlerror();
    arm_ = reinterpret_cast<FakeArmOf*>(dlsym(fake_, kFakeArmOf))();
    device_.open();
    waitFor(DeviceStatus::kOk);
  }
  void TearDown() override {
    device_.close();
    dlclose(fake_);
  }
  void waitFor(DeviceStatus status) {
    while (device_.read(0).status != status) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  template <typename Function>
  Function* fake(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(fake_, name));
  }

  void* fake_ = nullptr;
  FakeArm* arm_ = nullptr;
  TouchHdDevice device_;
};

TEST_F(TouchHd, HasTheFiguresThatTheLibraryReports) {
  const DeviceInfo& info = device_.info();
  EXPECT_EQ(info.name, "3D Systems Touch");
  EXPECT_EQ(info.force_max_N, 3.3);
  EXPECT_EQ(info.force_continuous_N, 0.88);
  EXPECT_NEAR(info.stiffness_max_N_m, 1200, 1e-9);
  EXPECT_NEAR(info.damping_Ns_m, 0.5, 1e-9);
  EXPECT_LT((info.workspace_max - Vec3(0.08, 0.06, 0.035)).norm(), 1e-12);
}

TEST_F(TouchHd, IsCalibratedWhileItRuns) {
  arm_->not_ready = true;
  waitFor(DeviceStatus::kNotReady);
  arm_->not_ready = false;
  waitFor(DeviceStatus::kOk);
  EXPECT_GT(fake<unsigned int()>("hlFakeCalibrationUpdates")(), 0U);
}

TEST_F(TouchHd, WarmMotorsAreNoLossAndAFaultOfTheDeviceIs) {
  fake<void(unsigned int)>("hlFakeError")(0x200);  // warm motors
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_NE(device_.read(0).status, DeviceStatus::kNotReady);
  }
  waitFor(DeviceStatus::kOk);
  fake<void(unsigned int)>("hlFakeError")(0x300);  // device fault
  waitFor(DeviceStatus::kLost);
  waitFor(DeviceStatus::kOk);  // opened again
}

// Until the scheduler calls for the first time nothing new is known; that it was lost before must not lose it again.
TEST_F(TouchHd, IsNotLostAgainByWhatItReportedBefore) {
  const auto starts = fake<unsigned int()>("hlFakeStarts");
  const unsigned int before = starts();
  fake<void(bool)>("hlFakeHoldUp")(true);
  fake<void(unsigned int)>("hlFakeError")(0x300);  // device fault
  waitFor(DeviceStatus::kLost);
  while (starts() == before) std::this_thread::yield();
  for (int i = 0; i < 200; ++i) {  // four times as long as it takes to be opened again
    EXPECT_EQ(device_.read(0).status, DeviceStatus::kNotReady);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  fake<void(bool)>("hlFakeHoldUp")(false);
  waitFor(DeviceStatus::kOk);
  EXPECT_EQ(starts(), before + 1);
}

TEST_F(TouchHd, AServoThatFeedsNoForceHoldsNone) {
  while (arm_->force_D().y() < 0.9) {
    device_.write(Vec3(0, 1, 0));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  while (arm_->force_D().norm() > 1e-12) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace
}  // namespace hl::test::test_touch_hd
