// TouchHdDevice: 3D Systems Touch and PHANToM through the vendor's libHD (OpenHaptics), opened at run time.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "device/device.h"
#include "device/exchange.h"
#include "device/lifeline.h"
#include "device/vendor_library.h"

namespace hl {

/// The device works in its library's own thread, the scheduler: each of its ticks gives the servo thread the newest
/// sample and takes the newest force, and neither waits for the other.
class TouchHdDevice final : public Device {
 public:
  static constexpr VendorLibraryName kLibrary{
      "libHD.so", "HL_HD_LIBRARY",
      "install 3D Systems' OpenHaptics 3.4 and the Touch driver for Linux (from support.3dsystems.com)"};

  ~TouchHdDevice() override { close(); }

  void open() override;
  void close() override;
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3& force_N) override;

  /// What is there. Throws hl::Error with what to install.
  static std::string find();

 private:
  // The vendor's C types.
  using Handle = unsigned int;
  struct ErrorInfo {
    unsigned int code;
    int internal;
    Handle device;
  };
  using Callback = unsigned int(void*);

  // The part of libHD that HL calls.
  struct Calls {
    Handle (*init_device)(const char* name);
    void (*disable_device)(Handle device);
    void (*make_current)(Handle device);
    void (*begin_frame)(Handle device);
    void (*end_frame)(Handle device);
    void (*enable)(unsigned int capability);
    void (*get_double)(unsigned int name, double* values);
    void (*get_integer)(unsigned int name, int* values);
    void (*set_double)(unsigned int name, const double* values);
    const char* (*get_string)(unsigned int name);
    ErrorInfo (*get_error)();
    const char* (*error_string)(unsigned int code);
    unsigned int (*check_calibration)();
    void (*update_calibration)(unsigned int style);
    void (*start_scheduler)();
    void (*stop_scheduler)();
    void (*set_scheduler_rate)(unsigned long rate_Hz);
    unsigned long (*schedule)(Callback* callback, void* user, unsigned short priority);
    void (*unschedule)(unsigned long callback);
  };

  static Calls bindCalls(const VendorLibrary& library);
  std::string begin();  // why it cannot; empty when it has
  void end();
  bool reopen();
  void describe();
  void frame();  // the scheduler's thread, as the next three
  Stylus stylusNow();
  DeviceStatus calibrate();

  std::unique_ptr<VendorLibrary> library_;  // null: closed
  Calls calls_{};
  Handle handle_ = 0;
  bool running_ = false;
  unsigned long callback_ = 0;
  int calibration_style_ = 0;
  DeviceInfo info_;
  Exchange exchange_;                // with the scheduler
  std::atomic<bool> failed_{false};  // the scheduler met an error
  std::unique_ptr<Lifeline> lifeline_;
};

}  // namespace hl
