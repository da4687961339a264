// MemoryBudget: what all clients' scenes may take of a server's memory together. One that does not fit is refused
// before it is built; the machine would end the whole server.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace hl {

/// Any thread. Outlives its shares.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t most_bytes) : most_(most_bytes) {}
  std::uint64_t most_bytes() const { return most_; }
  std::uint64_t used_bytes() const { return used_.load(std::memory_order_relaxed); }

 private:
  friend class MemoryShare;
  bool take(std::uint64_t bytes);

  const std::uint64_t most_;
  std::atomic<std::uint64_t> used_{0};
};

/// What one part of a server has of a budget, until it goes. One thread at a time.
class MemoryShare {
 public:
  MemoryShare() = default;  ///< of memory that nobody counts
  explicit MemoryShare(MemoryBudget& budget) : budget_(&budget) {}
  MemoryShare(MemoryShare&& other) noexcept
      : budget_(std::exchange(other.budget_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  MemoryShare& operator=(MemoryShare&& other) noexcept;
  ~MemoryShare() { set(0); }

  /// So much more. Throws hl::Error, and takes nothing, when there is not so much left.
  void take(std::uint64_t bytes);
  /// So much from now on, whatever is left: it is in use already.
  void set(std::uint64_t bytes);
  std::uint64_t bytes() const { return bytes_; }

 private:
  MemoryBudget* budget_ = nullptr;
  std::uint64_t bytes_ = 0;
};

}  // namespace hl
