// FakeArm: the hardware behind every fake: HL's simulated arm and hand, on the real clock or on one that the test
// moves. A fake speaks a driver's language on one side and moves this arm on the other; the test looks at the arm
// itself. One lock keeps the two apart: the arm moves on the thread that reads it.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <thread>

#include "base/clock.h"
#include "device/simulated_device.h"

namespace hl::test {

/// It has to keep up with the real clock under the sanitizers and beside other tests, so it makes large steps.
inline SimulatedDeviceSettings quickArm() {
  SimulatedDeviceSettings settings;
  settings.step_s = 1e-4;
  return settings;
}

class FakeArm {
  // A lock that calls nothing but the clock's sleep: the fake stands on the path of the servo step, where the guard of
  // the tests allows no mutex.
  class Turn {
   public:
    explicit Turn(std::atomic_flag& taken) : taken_(taken) {
      while (taken_.test_and_set(std::memory_order_acquire)) std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
    ~Turn() { taken_.clear(std::memory_order_release); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    std::atomic_flag& taken_;
  };

 public:
  // The fake's side. Frame D; any thread.
  DeviceSample read(std::int64_t now_ns) {
    const Turn turn(taken_);
    return device_.read(now_ns);
  }
  void write(const Vec3& force_D) {
    const Turn turn(taken_);
    device_.write(force_D);
    strongest_N_ = std::max(strongest_N_, device_.arm().motorForce_N().norm());
  }
  Vec3 encoders() { return read(now_ns()).position; }
  void pull(const Vec3& force_D) {
    encoders();
    write(force_D);
  }
  const DeviceInfo& info() const { return device_.info(); }
  SimulatedHand* hand() { return &device_; }
  void stop() noexcept { device_.stop(); }

  // The test's side. Any thread.
  std::int64_t now_ns() const { return virtual_ ? virtual_ns_.load() : monotonicNow_ns(); }
  void useVirtualClock() { virtual_ = true; }
  void useRealClock() { virtual_ = false; }
  void advance(double elapsed_s) {
    virtual_ns_ += static_cast<std::int64_t>(1e9 * elapsed_s);
    encoders();
  }
  void setHandGoal(const Vec3& goal_D) {
    const Turn turn(taken_);
    device_.setHandGoal(goal_D);
  }
  Vec3 trueTip_D() {
    const Turn turn(taken_);
    return device_.trueTip_D();
  }
  Vec3 force_D() {
    const Turn turn(taken_);
    return device_.arm().motorForce_N();
  }
  double strongest_N() {
    const Turn turn(taken_);
    return strongest_N_;
  }

  /// The stylus on it, which the arm does not move. Frame D.
  void turn(const Eigen::Quaterniond& turned_D) {
    const Turn turn(taken_);
    turned_D_ = turned_D;
  }
  Eigen::Quaterniond turned_D() {
    const Turn turn(taken_);
    return turned_D_;
  }

  std::atomic<double> gripper_rad{0};
  std::atomic<bool> lost{false};       ///< the device does not answer
  std::atomic<bool> not_ready{false};  ///< it answers, but is not calibrated
  std::atomic<unsigned> buttons{0};

 private:
  std::atomic_flag taken_;
  SimulatedDevice device_{quickArm()};
  double strongest_N_ = 0;
  Eigen::Quaterniond turned_D_ = Eigen::Quaterniond::Identity();
  std::atomic<bool> virtual_{false};
  std::atomic<std::int64_t> virtual_ns_{0};
};

/// Exported by the fakes that are shared libraries, under these names.
using FakeArmOf = FakeArm*();
inline constexpr const char* kFakeArmOf = "hlFakeArm";
using FakeArmNumber = FakeArm*(std::size_t);
inline constexpr const char* kFakeArmNumber = "hlFakeArmNumber";  ///< the first and the second, from 0
using FakePlugIn = void(std::size_t);
inline constexpr const char* kFakePlugIn = "hlFakePlugIn";  ///< how many there are: 1, unless HL_FAKE_DEVICES says 2

inline constexpr std::size_t kFakeDevices = 2;  ///< at the most

inline std::size_t fakeDevicesAtFirst() {
  const char* devices = std::getenv("HL_FAKE_DEVICES");
  return devices != nullptr && *devices == '2' ? 2 : 1;
}

}  // namespace hl::test
