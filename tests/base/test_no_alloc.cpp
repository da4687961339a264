// NoAlloc: the hooks count every allocation, and one inside a guarded scope aborts.
#include "base/no_alloc.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace hl {
namespace {

// Kept from the optimiser, which may drop an allocation that nobody sees.
void allocate(std::size_t count) {
  std::vector<int> values(count, 1);
  const volatile int* seen = values.data();
  (void)*seen;
}

TEST(NoAlloc, TheHooksAreAlive) {
  const std::uint64_t before = NoAlloc::allocations();
  allocate(1000);
  EXPECT_GT(NoAlloc::allocations(), before);
}

TEST(NoAllocDeathTest, AnAllocationInsideTheScopeAborts) {
  EXPECT_DEATH(
      {
        const NoAlloc guard;
        allocate(1000);
      },
      "must not allocate");
}

TEST(NoAllocDeathTest, AReleaseInsideTheScopeAborts) {
  EXPECT_DEATH(
      {
        auto owned = std::make_unique<std::vector<int>>(100);
        const NoAlloc guard;
        owned.reset();
      },
      "must not allocate");
}

TEST(NoAlloc, OtherThreadsAndLaterScopesAreFree) {
  std::atomic<bool> go{false};
  std::thread other([&] {
    while (!go.load()) std::this_thread::yield();
    allocate(1000);
  });
  {
    const NoAlloc outer;
    const NoAlloc inner;
    go.store(true);
  }
  other.join();
  allocate(1000);
}

}  // namespace
}  // namespace hl
