// FaultGroup: devices of which none makes force while one is in fault, such as the two hands of one task.
#pragma once

#include <atomic>
#include <cstdint>

namespace hl {

/// Shared by the sessions of a server whose faults are joined. Any thread; RT-safe.
class FaultGroup {
 public:
  static constexpr std::uint32_t kMaxDevices = 32;  ///< numbers are below

  /// Device `number` is in a fault of its own, or no longer.
  void set(std::uint32_t number, bool at_fault) {
    if (at_fault)
      at_fault_.fetch_or(bitOf(number), std::memory_order_acq_rel);
    else if (isSet(number))
      at_fault_.fetch_and(~bitOf(number), std::memory_order_acq_rel);
  }
  /// Another one than `number` is in a fault of its own.
  bool othersFail(std::uint32_t number) const {
    return (at_fault_.load(std::memory_order_acquire) & ~bitOf(number)) != 0;
  }

  /// To arm one is to arm all; counted.
  void rearm() { arm_requests_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t armRequests() const { return arm_requests_.load(std::memory_order_relaxed); }

 private:
  static std::uint32_t bitOf(std::uint32_t number) { return std::uint32_t{1} << number; }
  bool isSet(std::uint32_t number) const { return (at_fault_.load(std::memory_order_relaxed) & bitOf(number)) != 0; }

  std::atomic<std::uint32_t> at_fault_{0};  // bit i: device i
  std::atomic<std::uint64_t> arm_requests_{0};
};

}  // namespace hl
