// Shared numbers: a few numbers that one thread writes and any number of others read, all of one moment.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace hl {

/// Neither side waits for a lock; a reader reads again where they have changed meanwhile (a sequence lock).
template <std::size_t kCount>
class SharedNumbers {
 public:
  /// One thread at a time. RT-safe.
  void write(const std::array<double, kCount>& numbers) {
    writes_.fetch_add(1, std::memory_order_acq_rel);  // odd: they are being written
    for (std::size_t i = 0; i < kCount; ++i) numbers_[i].store(numbers[i], std::memory_order_relaxed);
    writes_.fetch_add(1, std::memory_order_acq_rel);
  }
  /// Any thread.
  std::array<double, kCount> read() const {
    for (;;) {
      const std::uint64_t before = writes_.load(std::memory_order_acquire);
      std::array<double, kCount> numbers;
      for (std::size_t i = 0; i < kCount; ++i) numbers[i] = numbers_[i].load(std::memory_order_relaxed);
      // Adding nothing keeps the reads above before it, as no load could.
      if (before % 2 == 0 && writes_.fetch_add(0, std::memory_order_acq_rel) == before) return numbers;
    }
  }

 private:
  std::array<std::atomic<double>, kCount> numbers_{};
  mutable std::atomic<std::uint64_t> writes_{0};
};

}  // namespace hl
