// SpscRing: a bounded queue from one thread to one other, without locks; when full the newest value is dropped.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace hl {

/// push() by one thread, pop() by one other. RT-safe on both sides. N is a power of two.
template <typename T, std::size_t N>
class SpscRing {
  static_assert((N & (N - 1)) == 0);

 public:
  bool push(const T& value) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == N) return false;
    items_[head & (N - 1)] = value;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  bool pop(T& value) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    value = items_[tail & (N - 1)];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<T, N> items_{};
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace hl
