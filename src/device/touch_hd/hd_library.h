// HdLibrary: libHD as all its devices in this process share it: one library, one scheduler, one current device, and one
// stack of errors.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>

#include "base/function_ref.h"
#include "device/vendor_library.h"

namespace hl {

/// The part of libHD that HL calls, and the vendor's C types.
struct HdCalls {
  using Handle = unsigned int;
  struct ErrorInfo {
    unsigned int code;
    int internal;
    Handle device;
  };
  using Callback = unsigned int(void*);

  Handle (*init_device)(const char* name);
  void (*disable_device)(Handle device);
  void (*make_current)(Handle device);
  Handle (*current_device)();
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
  void (*schedule_and_wait)(Callback* callback, void* user, unsigned short priority);
  void (*unschedule)(unsigned long callback);
};

class HdLibrary {
 public:
  static constexpr VendorLibraryName kName{
      "libHD.so", "HL_HD_LIBRARY",
      "install 3D Systems' OpenHaptics 3.4 and the Touch driver for Linux (from support.3dsystems.com)"};
  static constexpr unsigned long kSchedulerRate_Hz = 1000;
  static constexpr unsigned short kMaxPriority = 0xFFFF;  ///< of a callback: forces are set last of all
  static constexpr HdCalls::Handle kNoDevice = 0xFFFFFFFF;

  /// What the library does not keep apart for its devices. A device has one from open() to close().
  struct Seat {
    std::atomic<HdCalls::Handle> handle{kNoDevice};  ///< while it is open
    std::atomic<bool> failed{false};                 ///< the library reported an error of this device
    bool taken = false;                              ///< under setup()
  };

  /// The one of this process, as long as anybody has it. Throws hl::Error with what to install.
  static std::shared_ptr<HdLibrary> shared();

  const HdCalls& calls() const { return calls_; }
  /// Held while a device is opened or closed: one at a time.
  std::mutex& setup() { return setup_; }

  // Under setup().
  /// Throws hl::Error when all are taken.
  Seat& takeSeat();
  void leaveSeat(Seat& seat);
  int seatsTaken() const { return taken_; }
  /// Another seat has the same device.
  bool isOfAnother(const Seat& seat) const;
  /// Starts the scheduler where it does not run, and stops it.
  void start();
  void pause();
  /// Runs `work` between the frames of all devices: it may make another device the current one.
  void between(FunctionRef<void()> work);

  /// Takes the errors off the library's stack, each to the seat of its device. One that names no device that is open
  /// counts for `own` where that is the only one. Returns the last that counts for `own` or for nobody, 0: none. Any
  /// thread.
  unsigned int sortErrors(Seat& own);

 private:
  HdLibrary();

  VendorLibrary library_;
  HdCalls calls_;
  std::mutex setup_;
  bool running_ = false;
  static constexpr std::size_t kMaxDevices = 16;  // of a server
  std::array<Seat, kMaxDevices> seats_;
  std::atomic<int> taken_{0};
};

}  // namespace hl
