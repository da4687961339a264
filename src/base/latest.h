// Latest: one writer hands its newest value to one reader, without locks and without waiting.
// Triple buffer: writer and reader each own a slot, the third is swapped through one atomic
// (Simpson, "Four-slot fully asynchronous communication mechanism", 1990, is the ancestor).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace hl {

/// write() by one thread, read() by one other. RT-safe on both sides; T is copied.
template <typename T>
class Latest {
 public:
  /// Read before anything is written it gives `initial`: there is always one, as some types, Eigen's above all, are
  /// left uninitialised by their own constructors.
  explicit Latest(const T& initial) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}

  /// Publishes `value`; an unread older value is overwritten.
  void write(const T& value) {
    slots_[back_].value = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Takes over the newest value if there is one; returns whether there was.
  bool read(T& value) {
    const bool fresh = (middle_.load(std::memory_order_relaxed) & kFresh) != 0;
    if (fresh) front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    value = slots_[front_].value;
    return fresh;
  }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;
  struct alignas(64) Slot {
    T value;
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::atomic<std::uint32_t> middle_{1};
  alignas(64) std::uint32_t back_ = 0;   // the writer's slot
  alignas(64) std::uint32_t front_ = 2;  // the reader's slot
};

}  // namespace hl
