// What is taken of a budget is given back, and never more than there is.
#include "base/memory_budget.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/machine_memory.h"

namespace hl::test_memory_budget {
namespace {

TEST(MemoryBudget, WhatDoesNotFitIsRefusedAndTakesNothing) {
  MemoryBudget budget(100'000'000);
  MemoryShare first(budget);
  first.take(60'000'000);
  MemoryShare second(budget);
  second.take(40'000'000);
  try {
    second.take(1'000'000);
    FAIL() << "there was nothing left";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "there is no room for 1 MB more: the scenes of all clients take 100 MB of 100 MB that this server keeps for "
        "them, with a part for each: show less, or raise its limit on memory");
  }
  EXPECT_THROW(second.take(std::numeric_limits<std::uint64_t>::max()), Error);
  EXPECT_EQ(second.bytes(), 40'000'000U);
  EXPECT_EQ(budget.used_bytes(), 100'000'000U);
}

TEST(MemoryBudget, WhatGoesGivesItsShareBack) {
  MemoryBudget budget(100);
  {
    MemoryShare share(budget);
    share.take(70);
    MemoryShare moved(std::move(share));
    MemoryShare other(budget);
    other.take(20);
    other = std::move(moved);
    EXPECT_EQ(other.bytes(), 70U);
    EXPECT_EQ(budget.used_bytes(), 90U);
  }
  EXPECT_EQ(budget.used_bytes(), 0U);
}

TEST(MemoryBudget, WhatIsInUseAlreadyCountsWhateverIsLeft) {
  MemoryBudget budget(100);
  MemoryShare share(budget);
  share.set(300);
  EXPECT_EQ(budget.used_bytes(), 300U);
  MemoryShare other(budget);
  EXPECT_THROW(other.take(1), Error);
  share.set(40);
  other.take(60);
  EXPECT_EQ(budget.used_bytes(), 100U);
}

TEST(MemoryBudget, AGreedyMemberLeavesAPartForEachOfTheOthers) {
  const MemoryBudget budget(1000, 5);  // 100 for each
  const MemoryBudget greedy = budget.member(), modest = budget.member();
  MemoryShare all(greedy), some(modest);
  EXPECT_THROW(all.take(601), Error);
  all.take(600);
  EXPECT_THROW(all.take(1), Error);
  EXPECT_THROW(some.take(101), Error);
  some.take(100);
  all.set(550);
  some.take(50);
  EXPECT_EQ(budget.used_bytes(), 700U);
  MemoryShare nobodys(budget);
  EXPECT_THROW(nobodys.take(1), Error) << "only members have a part";
}

TEST(MemoryBudget, ThereAreNoMorePartsThanMembers) {
  const MemoryBudget budget(1000, 1);
  auto first = std::make_unique<MemoryBudget>(budget.member());
  const MemoryBudget second = budget.member();
  MemoryShare share(second);
  EXPECT_THROW(share.take(501), Error);
  first.reset();
  const MemoryBudget third = budget.member();
  MemoryShare whole(third);
  whole.take(1000);
}

TEST(MemoryBudget, AnObjectKeepsItsShareAsLongAsAnybodyHasIt) {
  const MemoryBudget budget(100);
  MemoryShare share(budget);
  share.take(40);
  auto object = withShare(std::make_shared<int>(7), std::move(share));
  const std::shared_ptr<const int> other = object;
  object.reset();
  EXPECT_EQ(*other, 7);
  EXPECT_EQ(budget.used_bytes(), 40U);
}

TEST(MemoryBudget, AShareOfNothingTakesAll) {
  MemoryShare share;
  share.take(std::numeric_limits<std::uint64_t>::max());
}

TEST(MemoryBudget, ManyThreadsNeverTakeMoreThanThereIs) {
  MemoryBudget budget(1000);
  std::vector<std::thread> threads;
  for (std::uint64_t each = 1; each <= 4; ++each) {
    threads.emplace_back([&budget, each] {
      for (int i = 0; i < 10'000; ++i) {
        MemoryShare share(budget);
        try {
          share.take(150 * each);
        } catch (const Error&) {
        }
        EXPECT_LE(budget.used_bytes(), 1000U);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(budget.used_bytes(), 0U);
}

TEST(MachineMemory, IsTheLeastThatAGroupAllows) {
  const auto root = std::filesystem::path(testing::TempDir()) / "hl_memory_groups";
  std::filesystem::create_directories(root / "outer" / "inner");
  std::ofstream(root / "outer" / "memory.max") << "5000\n";
  std::ofstream(root / "outer" / "inner" / "memory.max") << "max\n";
  EXPECT_EQ(memoryOfGroup(root, "/outer/inner", 9000), 5000U);
  EXPECT_EQ(memoryOfGroup(root, "/outer/inner", 4000), 4000U);
  EXPECT_EQ(memoryOfGroup(root, "/nowhere", 9000), 9000U);
  EXPECT_EQ(memoryOfGroup(root, "", 9000), 9000U);
  std::filesystem::remove_all(root);
}

TEST(MachineMemory, TheGroupIsTheOneOfVersionTwo) {
  std::istringstream both("12:memory:/old\n0::/system.slice/hld.service\n");
  EXPECT_EQ(memoryGroup(both), "/system.slice/hld.service");
  std::istringstream old("12:memory:/old\n");
  EXPECT_EQ(memoryGroup(old), "");
  EXPECT_GT(machineMemory_bytes(), 100'000'000U);
}

// As `ulimit -v` sets it.
TEST(MachineMemory, IsNoMoreThanTheProgramMayTake) {
  const auto limited = [] {
    const std::uint64_t before = machineMemory_bytes();
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = before / 2;
    return setrlimit(RLIMIT_AS, &limit) == 0 && machineMemory_bytes() == before / 2;
  };
  EXPECT_EXIT(_exit(limited() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace hl::test_memory_budget
