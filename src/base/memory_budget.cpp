#include "base/memory_budget.h"

#include <string>

#include "base/error.h"

namespace hl {

namespace {

std::string megabytes(double bytes) { return std::to_string(static_cast<std::uint64_t>(1e-6 * bytes)) + " MB"; }

}  // namespace

bool MemoryBudget::take(std::uint64_t bytes) {
  std::uint64_t used = used_bytes();
  do {
    if (used > most_ || bytes > most_ - used) return false;
  } while (!used_.compare_exchange_weak(used, used + bytes, std::memory_order_relaxed));
  return true;
}

MemoryShare& MemoryShare::operator=(MemoryShare&& other) noexcept {
  std::swap(budget_, other.budget_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void MemoryShare::take(std::uint64_t bytes) {
  if (budget_ != nullptr && !budget_->take(bytes))
    throw Error("with this the scenes of all clients would take " +
                megabytes(static_cast<double>(budget_->used_bytes()) + static_cast<double>(bytes)) +
                "; this server keeps " + megabytes(static_cast<double>(budget_->most_bytes())) +
                " for them: show less, or raise its limit on memory");
  bytes_ += bytes;
}

void MemoryShare::set(std::uint64_t bytes) {
  if (budget_ != nullptr)
    budget_->used_.fetch_add(bytes - bytes_, std::memory_order_relaxed);  // wraps where it is less
  bytes_ = bytes;
}

}  // namespace hl
