// MemoryBudget: what all clients may make a server keep. What does not fit is refused before it is made; the machine
// would end the whole server. Half of a budget is for those who come first; the other half is set aside in equal parts,
// one for each member, so that a greedy client leaves room for a modest one.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

namespace hl {

/// A handle: copies are of the same budget, which lives as long as any of them and of its shares. Any thread.
class MemoryBudget {
 public:
  MemoryBudget() = default;  ///< of memory that nobody counts
  /// Without members all of it is for those who come first.
  explicit MemoryBudget(std::uint64_t most_bytes, std::uint32_t members = 0);
  /// The same budget as a new member has it. One beyond their number has no part set aside.
  MemoryBudget member() const;
  std::uint64_t most_bytes() const;
  std::uint64_t used_bytes() const;  ///< of all members

 private:
  friend class MemoryShare;
  struct Pool;
  class Member;
  explicit MemoryBudget(std::shared_ptr<Member> member) : member_(std::move(member)) {}

  std::shared_ptr<Member> member_;
};

/// What one thing has of a budget, until it goes. One thread at a time.
class MemoryShare {
 public:
  MemoryShare() = default;  ///< of memory that nobody counts
  explicit MemoryShare(const MemoryBudget& budget) : member_(budget.member_) {}
  MemoryShare(MemoryShare&& other) noexcept
      : member_(std::move(other.member_)), bytes_(std::exchange(other.bytes_, 0)) {}
  MemoryShare& operator=(MemoryShare&& other) noexcept;
  ~MemoryShare() { set(0); }

  /// So much more. Throws hl::Error, and takes nothing, when there is not so much left.
  void take(std::uint64_t bytes);
  /// At least so much in all, as take().
  void takeUpTo(std::uint64_t bytes) {
    if (bytes > bytes_) take(bytes - bytes_);
  }
  /// So much from now on, whatever is left: it is in use already.
  void set(std::uint64_t bytes);
  /// What another of the same member has.
  void add(MemoryShare other) { bytes_ += std::exchange(other.bytes_, 0); }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::shared_ptr<MemoryBudget::Member> member_;
  std::uint64_t bytes_ = 0;
};

/// The same object; the share goes back when the last pointer to it has gone, wherever that is.
template <typename T>
std::shared_ptr<T> withShare(std::shared_ptr<T> object, MemoryShare share) {
  struct Both {
    Both(MemoryShare taken, std::shared_ptr<T> given) : share(std::move(taken)), object(std::move(given)) {}
    MemoryShare share;  // in this order: it goes after the object
    std::shared_ptr<T> object;
  };
  auto both = std::make_shared<Both>(std::move(share), std::move(object));
  T* const there = both->object.get();
  return {std::move(both), there};
}

}  // namespace hl
