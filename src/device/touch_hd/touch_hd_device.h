// TouchHdDevice: 3D Systems Touch and PHANToM through the vendor's libHD (OpenHaptics), opened at run time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "base/function_ref.h"
#include "device/device.h"
#include "device/device_claim.h"
#include "device/exchange.h"
#include "device/lifeline.h"
#include "device/touch_hd/hd_library.h"

namespace hl {

/// The device works in its library's own thread, the scheduler: each of its ticks gives the servo thread the newest
/// sample and takes the newest force, and neither waits for the other.
class TouchHdDevice final : public Device {
 public:
  /// `name`: as the vendor's set-up program has it; empty: the default device.
  explicit TouchHdDevice(std::string name = "") : name_(std::move(name)) {}
  ~TouchHdDevice() override { close(); }

  void open() override;
  void close() override;
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3& force_N) override;

  /// What is there. Throws hl::Error with what to install.
  static std::string find();

 private:
  std::string begin();  // why it cannot; empty when it has
  std::string prepare();
  void end();
  void disable();
  void leave();
  bool reopen();
  void describe();
  void frame();  // the scheduler's thread, as the next three
  bool asCurrent(FunctionRef<void()> work);
  Stylus stylusNow() const;
  DeviceStatus calibrate();

  const std::string name_;
  std::shared_ptr<HdLibrary> library_;  // null: closed
  HdLibrary::Seat* seat_ = nullptr;
  HdCalls::Handle handle_ = HdLibrary::kNoDevice;  // of a device that runs
  DeviceClaim claim_;
  unsigned long callback_ = 0;
  int calibration_style_ = 0;
  DeviceInfo info_;
  Exchange exchange_;  // with the scheduler
  std::unique_ptr<Lifeline> lifeline_;
};

}  // namespace hl
