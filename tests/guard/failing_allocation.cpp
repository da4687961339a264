#include "guard/failing_allocation.h"

#include <atomic>
#include <cstring>

#include "base/guarded_thread.h"

namespace hl {

namespace {

std::atomic<const char*> failing_thread{nullptr};
std::atomic<std::int64_t> left{0};  // allocations until it fails; below 1: it has

}  // namespace

void FailingAllocation::arm(const char* thread, std::int64_t nth) {
  left.store(nth);
  failing_thread.store(thread);
}

bool FailingAllocation::hasFailed() { return left.load() < 1; }

bool FailingAllocation::disarm() {
  failing_thread.store(nullptr);
  return hasFailed();
}

bool FailingAllocation::isNow() noexcept {
  const char* const thread = failing_thread.load(std::memory_order_relaxed);
  if (thread == nullptr || std::strcmp(thread, threadName()) != 0) return false;
  return left.fetch_sub(1) == 1;
}

}  // namespace hl
