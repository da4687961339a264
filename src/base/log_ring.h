// LogRing: the last values of a loop, to be read later. The writer never waits and never asks: it
// overwrites the oldest. A reader counts, so it knows what it has missed.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>

namespace hl {

/// push() by one thread, RT-safe; read() by any others. T is copied as plain memory: no pointers of its own.
template <typename T>
class LogRing {
  static_assert(std::is_trivially_destructible_v<T> && sizeof(T) % sizeof(std::uint64_t) == 0);

 public:
  /// Holds the last `room` values or more. Allocates.
  explicit LogRing(std::size_t room)
      : slots_(std::make_unique<Slot[]>(std::bit_ceil(room))), mask_(std::bit_ceil(room) - 1) {}

  void push(const T& value) {
    const std::uint64_t number = pushed_.load(std::memory_order_relaxed);
    Slot& slot = slots_[number & mask_];
    std::uint64_t words[kWords];
    std::memcpy(words, static_cast<const void*>(&value), sizeof(T));
    // A reader that sees any of the new words also sees that the slot is being written: each store releases that.
    slot.state.store(2 * number + 1, std::memory_order_relaxed);
    for (std::size_t i = 0; i < kWords; ++i) slot.words[i].store(words[i], std::memory_order_release);
    slot.state.store(2 * number + 2, std::memory_order_release);
    pushed_.store(number + 1, std::memory_order_release);
  }

  /// How many there have been; the newest has the number pushed() - 1.
  std::uint64_t pushed() const { return pushed_.load(std::memory_order_acquire); }
  std::size_t room() const { return mask_ + 1; }
  /// False when `number` has been overwritten, or is yet to come.
  bool read(std::uint64_t number, T& value) const {
    const Slot& slot = slots_[number & mask_];
    if (slot.state.load(std::memory_order_acquire) != 2 * number + 2) return false;
    std::uint64_t words[kWords];
    for (std::size_t i = 0; i < kWords; ++i) words[i] = slot.words[i].load(std::memory_order_acquire);
    if (slot.state.load(std::memory_order_relaxed) != 2 * number + 2) return false;
    std::memcpy(static_cast<void*>(&value), words, sizeof(T));
    return true;
  }

 private:
  static constexpr std::size_t kWords = sizeof(T) / sizeof(std::uint64_t);
  struct Slot {
    std::atomic<std::uint64_t> state{0};  // 2 n + 1 while value n is written, 2 n + 2 when it is there
    std::atomic<std::uint64_t> words[kWords]{};
  };
  std::unique_ptr<Slot[]> slots_;
  std::size_t mask_;
  alignas(64) std::atomic<std::uint64_t> pushed_{0};
};

}  // namespace hl
