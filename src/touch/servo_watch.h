// ServoWatch: the thread that watches the servo from outside. When the servo stands still, in a driver's call or
// because the machine does not run it, the device is stopped by a way of its own, and the servo, should it go on,
// finds itself in fault.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "base/guarded_thread.h"
#include "base/periodic.h"
#include "device/device.h"

namespace hl {

/// start() and stop() by one thread; takeStall() by the servo's; stalled() by any.
class ServoWatch {
 public:
  static constexpr std::int64_t kLook_ns = 1'000'000;

  /// `servo`: counts the steps that are watched. `on_stall` is called by the watching thread. All outlive it.
  ServoWatch(Device& device, const LoopCounters& servo, std::function<void()> on_stall)
      : device_(device), servo_(servo), on_stall_(std::move(on_stall)) {}
  ~ServoWatch() { stop(); }

  /// How many looks without a step are a stall. With real-time priority 50 ms are no hiccup and no long tick; without,
  /// the scheduler may leave a thread alone for longer, and only a quarter of a second is none. A slow servo is looked
  /// at for longer.
  static std::uint32_t looks(bool real_time, double servo_rate_Hz);

  void start(std::uint32_t looks);
  void stop();
  /// Since the last call the servo has stood still, and the device was stopped.
  bool takeStall() { return stalled_.exchange(false, std::memory_order_acq_rel); }
  /// It stands still, or has and has not taken it yet.
  bool stalled() const { return stalled_.load(std::memory_order_acquire); }

 private:
  void run(std::uint32_t looks);

  Device& device_;
  const LoopCounters& servo_;
  const std::function<void()> on_stall_;
  LoopCounters counters_;
  std::atomic<bool> stalled_{false};
  LoopThread thread_;
};

}  // namespace hl
