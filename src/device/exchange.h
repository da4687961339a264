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
  /// What was told last, at `now_ns`; lost when it says nothing of where the hand is now.
  DeviceSample newest(std::int64_t now_ns) {
    DeviceSample sample;
    samples_.read(sample);
    if (sample.status == DeviceStatus::kOk && monotonicNow_ns() - sample.time_ns > kStale_ns)
      sample.status = DeviceStatus::kLost;
    sample.time_ns = now_ns;
    return sample;
  }
  /// Non-finite components are taken as zero force.
  void pull(const Vec3& force_D) { forces_.write(force_D.allFinite() ? force_D : Vec3(Vec3::Zero())); }

  // The other thread, RT-safe.
  void tell(const Vec3& position_D, std::uint32_t buttons, DeviceStatus status) {
    samples_.write({monotonicNow_ns(), position_D, buttons, status});
  }
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

  Latest<DeviceSample> samples_;  // their times are of the monotonic clock
  Latest<Vec3> forces_{Vec3::Zero()};
  std::int64_t fed_ns_ = 0;  // of the other thread
};

}  // namespace hl
