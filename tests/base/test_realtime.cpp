// runPeriodic: every step is at a whole number of periods, a late step skips periods instead of running in a burst, and
// what disturbs the loop is counted.
#include "base/realtime.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/periodic.h"

namespace hl::test_realtime {
namespace {

constexpr std::int64_t kPeriod_ns = 2'000'000;

TEST(RunPeriodic, StepsAndSkippedPeriodsTogetherAccountForAllTime) {
  std::atomic<bool> running{true};
  LoopCounters counters;
  std::vector<std::int64_t> scheduled_ns;
  runPeriodic(kPeriod_ns, running, counters, [&](std::int64_t now_ns) {
    scheduled_ns.push_back(now_ns);
    EXPECT_LE(now_ns, monotonicNow_ns());
    if (scheduled_ns.size() == 20) running = false;
  });
  ASSERT_EQ(counters.steps.load(), 20u);
  std::uint64_t skipped = 0;
  for (std::size_t i = 1; i < scheduled_ns.size(); ++i) {
    const std::int64_t between_ns = scheduled_ns[i] - scheduled_ns[i - 1];
    ASSERT_GT(between_ns, 0);
    ASSERT_EQ(between_ns % kPeriod_ns, 0);
    skipped += static_cast<std::uint64_t>(between_ns / kPeriod_ns - 1);
  }
  // Periods lost before the first step are counted too, but leave no gap between steps.
  EXPECT_GE(counters.deadlines_missed.load(), skipped);
}

TEST(RunPeriodic, AnOverrunIsCountedAndNeverMadeUpForByABurst) {
  std::atomic<bool> running{true};
  LoopCounters counters;
  int steps = 0;
  std::int64_t overran_until_ns = 0;
  runPeriodic(kPeriod_ns, running, counters, [&](std::int64_t now_ns) {
    if (++steps == 3) {
      std::this_thread::sleep_for(std::chrono::nanoseconds(5 * kPeriod_ns + kPeriod_ns / 2));
      overran_until_ns = monotonicNow_ns();
    } else if (steps == 4) {
      // The next step belongs to the newest period that had begun, not to one long past.
      EXPECT_GT(now_ns, overran_until_ns - kPeriod_ns);
      running = false;
    }
  });
  EXPECT_EQ(counters.steps.load(), 4u);
  EXPECT_GE(counters.deadlines_missed.load(), 4u);
  EXPECT_GE(counters.late_max_ns.load(), 4 * kPeriod_ns);
}

TEST(RunPeriodic, EveryStepIsCountedByItsDuty) {
  std::atomic<bool> running{true};
  LoopCounters counters;
  int steps = 0;
  runPeriodic(kPeriod_ns, running, counters, [&](std::int64_t) {
    const std::int64_t end_ns = monotonicNow_ns() + (++steps % 2 == 0 ? kPeriod_ns * 6 / 10 : 2 * kPeriod_ns);
    while (monotonicNow_ns() < end_ns) {
    }
    if (steps == 10) running = false;
  });
  EXPECT_EQ(std::accumulate(counters.duty.begin(), counters.duty.end(), std::uint64_t{0}), 10u);
  EXPECT_GE(counters.duty.back(), 5u) << "those of two periods";
  for (std::size_t i = 0; kDutyBounds[i] < 0.6; ++i) EXPECT_EQ(counters.duty[i], 0u);
}

TEST(RunPeriodic, PagesThatAreNotThereAndWaitsWithinStepsAreCounted) {
  constexpr std::size_t kPages = 50, kPageBytes = 4096;
  void* const fresh = mmap(nullptr, kPages * kPageBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  madvise(fresh, kPages * kPageBytes, MADV_NOHUGEPAGE);
  std::atomic<bool> running{true};
  LoopCounters counters;
  std::size_t steps = 0;
  runPeriodic(kPeriod_ns, running, counters, [&](std::int64_t) {
    static_cast<volatile char*>(fresh)[steps * kPageBytes] = 1;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    if (++steps == kPages) running = false;
  });
  EXPECT_GE(counters.page_faults, kPages);
  // A deadline that had passed already was not waited for, and hides one.
  EXPECT_GE(counters.waits + counters.deadlines_missed, kPages / 2);
  munmap(fresh, kPages * kPageBytes);
}

TEST(SpareCore, IsOneOfSeveralAndNoTwoAreTheSame) {
  EXPECT_EQ(spareCore(1000), -1);
  const int first = spareCore(0), second = spareCore(1);
  if (first < 0) GTEST_SKIP() << "no core to spare on this machine";
  EXPECT_NE(first, second);
  std::thread pinned([&] {
    const RealtimeGrant grant = requestRealtime(1, first);
    EXPECT_EQ(grant.core, first) << grant.why;
    EXPECT_EQ(sched_getcpu(), first);
  });
  pinned.join();
}

std::size_t lockedMemory_kB() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kB = 0;
    if (word == "VmLck:" && status >> kB) return kB;
  }
  return 0;
}

// The process may be a program of somebody else's, that has linked libhl.
TEST(RequestRealtime, LeavesTheMemoryOfTheProcessAlone) {
  const std::size_t before = lockedMemory_kB();
  std::thread asking([] { EXPECT_FALSE(requestRealtime(1).memory_locked); });
  asking.join();
  EXPECT_EQ(lockedMemory_kB(), before);
}

// Locked for good: in a process of its own. What is not used yet takes no memory.
TEST(LockProcessMemoryDeathTest, LocksWhatIsUsedAndIsReported) {
#ifdef HL_SANITIZED
  GTEST_SKIP() << "the sanitizers' mlockall() locks nothing and says that it did";
#endif
  const auto work = [] {
    constexpr std::size_t kUnused_bytes = std::size_t{64} << 20;
    lockProcessMemory();
    const RealtimeGrant grant = requestRealtime(1);
    if (!grant.memory_locked) _exit(grant.why.find("memory is not locked") != std::string::npos ? 0 : 1);
    void* const unused = mmap(nullptr, kUnused_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const bool small = static_cast<std::size_t>(usage.ru_maxrss) * 1024 < kUnused_bytes;
    _exit(unused != MAP_FAILED && lockedMemory_kB() > 0 && small ? 0 : 2);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(0), "");
}

// Of the code of this program: how much of it there is, and how much has been touched.
std::pair<std::size_t, std::size_t> codeAndTouched_kB() {
  std::ifstream maps("/proc/self/smaps");
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::size_t size = 0, touched = 0;
  bool code = false;
  for (std::string line; std::getline(maps, line);) {
    if (line.find('-') < line.find(' ')) code = line.find(" r-xp ") != std::string::npos && line.ends_with(program);
    if (code && line.starts_with("Size:")) size += std::stoul(line.substr(5));
    if (code && line.starts_with("Rss:")) touched += std::stoul(line.substr(4));
  }
  return {size, touched};
}

TEST(TouchPrograms, NoCodeIsLeftToBeFoundLater) {
  touchPrograms();
  const auto [size, touched] = codeAndTouched_kB();
  if (size == 0) GTEST_SKIP() << "the kernel does not tell what of a mapping is in memory";
  EXPECT_EQ(touched, size);
}

TEST(RequestRealtime, SaysWhyACoreCouldNotBeHad) {
  std::thread asking([] {
    constexpr int kNoSuchCore = 1000;
    const RealtimeGrant grant = requestRealtime(1, kNoSuchCore);
    EXPECT_EQ(grant.core, -1);
    EXPECT_NE(grant.why.find("no core of its own (Invalid argument)"), std::string::npos) << grant.why;
  });
  asking.join();
}

TEST(RequestRealtime, SaysWhyWhatWasRefused) {
  std::thread asking([] {
    const RealtimeGrant grant = requestRealtime(1);
    EXPECT_EQ(grant.why.empty(), grant.fifo && grant.memory_locked);
  });
  asking.join();
}

}  // namespace
}  // namespace hl::test_realtime
