#include "base/memory_budget.h"

#include <limits>
#include <mutex>
#include <string>

#include "base/error.h"

namespace hl {

namespace {

std::string megabytes(std::uint64_t bytes) { return std::to_string(bytes / 1'000'000) + " MB"; }

}  // namespace

struct MemoryBudget::Pool {
  const std::uint64_t most, part;  // of all; set aside for each member
  const std::uint32_t members;     // that have a part
  const std::uint64_t common;      // what is not set aside
  mutable std::mutex mutex;        // of what follows
  std::uint64_t used = 0, used_of_common = 0;
  std::uint32_t with_part = 0;
};

class MemoryBudget::Member {
 public:
  Member(std::shared_ptr<Pool> pool, bool has_part) : pool_(std::move(pool)) {
    const std::lock_guard lock(pool_->mutex);
    if (!has_part || pool_->with_part == pool_->members) return;
    ++pool_->with_part;
    part_ = pool_->part;
    has_part_ = true;
  }
  ~Member() {
    const std::lock_guard lock(pool_->mutex);
    if (has_part_) --pool_->with_part;
  }
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  const std::shared_ptr<Pool>& pool() const { return pool_; }

  bool take(std::uint64_t bytes) {
    const std::lock_guard lock(pool_->mutex);
    if (bytes > std::numeric_limits<std::uint64_t>::max() - used_) return false;
    const std::uint64_t more = ofCommon(used_ + bytes) - ofCommon(used_);
    const bool full = pool_->used_of_common > pool_->common || more > pool_->common - pool_->used_of_common;
    if (more > 0 && full) return false;
    change(bytes, more);
    return true;
  }
  void replace(std::uint64_t before, std::uint64_t after) {
    const std::lock_guard lock(pool_->mutex);
    change(after - before, ofCommon(used_ + after - before) - ofCommon(used_));  // wraps where it is less
  }

 private:
  std::uint64_t ofCommon(std::uint64_t used) const { return used > part_ ? used - part_ : 0; }
  void change(std::uint64_t bytes, std::uint64_t of_common) {
    used_ += bytes;
    pool_->used += bytes;
    pool_->used_of_common += of_common;
  }

  const std::shared_ptr<Pool> pool_;
  bool has_part_ = false;
  std::uint64_t part_ = 0;
  std::uint64_t used_ = 0;  // under the pool's mutex
};

MemoryBudget::MemoryBudget(std::uint64_t most_bytes, std::uint32_t members) {
  const std::uint64_t part = members == 0 ? 0 : most_bytes / 2 / members;
  auto* const pool = new Pool{most_bytes, part, members, most_bytes - part * members, {}};
  member_ = std::make_shared<Member>(std::shared_ptr<Pool>(pool), false);
}

MemoryBudget MemoryBudget::member() const {
  return member_ ? MemoryBudget(std::make_shared<Member>(member_->pool(), true)) : MemoryBudget();
}

std::uint64_t MemoryBudget::most_bytes() const {
  return member_ ? member_->pool()->most : std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t MemoryBudget::used_bytes() const {
  if (!member_) return 0;
  const std::lock_guard lock(member_->pool()->mutex);
  return member_->pool()->used;
}

MemoryShare& MemoryShare::operator=(MemoryShare&& other) noexcept {
  std::swap(member_, other.member_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void MemoryShare::take(std::uint64_t bytes) {
  if (member_ && !member_->take(bytes)) {
    const MemoryBudget budget(member_);
    throw Error("there is no room for " + megabytes(bytes) + " more: the scenes of all clients take " +
                megabytes(budget.used_bytes()) + " of " + megabytes(budget.most_bytes()) +
                " that this server keeps for them, with a part for each: show less, or raise its limit on memory");
  }
  bytes_ += bytes;
}

void MemoryShare::set(std::uint64_t bytes) {
  if (member_) member_->replace(bytes_, bytes);
  bytes_ = bytes;
}

}  // namespace hl
