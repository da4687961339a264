// Exchange: between the servo thread and a thread that talks to a device. Each takes the newest of the other and
// neither waits; what is too old counts no more.
#pragma once

#include <cstdint>

#include "base/clock.h"
#include "base/latest.h"
#include "device/device.h"

namespace hl {

class Exchange {
 public:
  // The servo thread, RT-safe.
  /// What was last reported, at `now_ns`; lost when it says nothing of where the hand is now.
  DeviceSample newest(std::int64_t now_ns) {
    DeviceSample sample;
    const bool fresh = samples_.read(sample);
    const std::int64_t age_ns = monotonicNow_ns() - sample.time_ns;
    if (sample.status == DeviceStatus::kOk && age_ns > kStale_ns) sample.status = DeviceStatus::kLost;
    if (fresh) taken_ns_ = now_ns - age_ns;
    sample.age_ns = now_ns - taken_ns_;
    sample.time_ns = now_ns;
    return sample;
  }
  /// Non-finite components are taken as zero force.
  void pull(const Vec3& force_D) { forces_.write(force_D.allFinite() ? force_D : Vec3(Vec3::Zero())); }

  // The other thread, RT-safe.
  /// `asked_ns`: on the monotonic clock, when the device was asked where it is. A thread that is held up reports late.
  void report(std::int64_t asked_ns, const Vec3& position_D, std::uint32_t buttons, DeviceStatus status,
              const Stylus& stylus = {}) {
    DeviceSample sample{asked_ns, position_D, buttons, status};
    sample.stylus = stylus;
    samples_.write(sample);
  }
  /// It does not answer.
  void reportLost() { report(monotonicNow_ns(), Vec3::Zero(), 0, DeviceStatus::kLost); }
  /// The newest force; zero when the servo has been silent for so long that it no longer stands for it.
  Vec3 wantedForce() {
    Vec3 force;
    const std::int64_t now_ns = monotonicNow_ns();
    if (forces_.read(force)) fed_ns_ = now_ns;
    return now_ns - fed_ns_ > kUnfed_ns ? Vec3(Vec3::Zero()) : force;
  }

 private:
  static constexpr std::int64_t kStale_ns = 100'000'000;
  static constexpr std::int64_t kUnfed_ns = 50'000'000;

  Latest<DeviceSample> samples_{DeviceSample{}};  // their times are of the monotonic clock
  Latest<Vec3> forces_{Vec3::Zero()};
  std::int64_t taken_ns_ = 0;  // the newest sample on the clock of the servo; of the servo thread
  std::int64_t fed_ns_ = 0;    // of the other thread
};

}  // namespace hl
