// ForceDimensionDevice: delta, omega, sigma and lambda devices through the vendor's libdhd, opened at run time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "device/device.h"
#include "device/device_claim.h"
#include "device/force_dimension/device_choice.h"
#include "device/lifeline.h"
#include "device/vendor_library.h"

namespace hl {

class ForceDimensionDevice final : public Device {
 public:
  static constexpr VendorLibraryName kLibrary{
      "libdhd.so.3", "HL_DHD_LIBRARY",
      "install the Force Dimension SDK (version 3, free for owners, from forcedimension.com)"};

  explicit ForceDimensionDevice(ForceDimensionChoice choice = {}) : choice_(choice) {}
  ~ForceDimensionDevice() override { close(); }

  void open() override;
  void close() override;
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read(std::int64_t now_ns) override;
  void write(const Vec3& force_N) override;

  /// What is there. Throws hl::Error with what to install.
  static std::string find();

 private:
  // The part of libdhd that HL calls; C functions, `id` is what open gave.
  struct Calls {
    int (*device_count)();
    int (*open)();
    int (*open_id)(char index);
    int (*open_serial)(int serial);                     // null in old versions, as the next
    int (*serial_number)(unsigned short* sn, char id);  // of recent devices
    int (*close)(char id);
    int (*system_type)(char id);
    const char* (*system_name)(char id);
    int (*enable_force)(unsigned char on, char id);
    int (*set_gravity_compensation)(int on, char id);
    int (*set_watchdog)(unsigned char periods, char id);  // null in old versions
    int (*position)(double* x, double* y, double* z, char id);
    int (*set_force)(double x, double y, double z, char id);
    unsigned int (*button_mask)(char id);
    // Null in old versions, as is the watchdog.
    bool (*has_wrist)(char id);
    bool (*has_gripper)(char id);
    int (*orientation)(double frame[3][3], char id);
    int (*gripper_angle)(double* angle_rad, char id);
    int (*status)(int* status, char id);
    const char* (*last_error)();
  };

  static Calls bindCalls(const VendorLibrary& library);
  int openChosen() const;
  std::string begin();  // why it cannot; empty when it has
  std::string claimIt();
  DeviceStatus examine(std::int64_t now_ns);
  void lose();
  void describe();
  void readStylus();

  std::unique_ptr<VendorLibrary> library_;  // null: closed
  Calls calls_{};
  ForceDimensionChoice choice_;  // once it was open: by its serial number, where it has one
  char id_ = -1;
  DeviceClaim claim_;
  DeviceInfo info_;
  DeviceStatus status_ = DeviceStatus::kNotReady;  // when it was examined last
  std::int64_t examined_ns_ = 0;
  bool watched_ = false;  // the watchdog runs
  Vec3 position_ = Vec3::Zero();
  Stylus stylus_;  // as last reported
  std::unique_ptr<Lifeline> lifeline_;
};

}  // namespace hl
