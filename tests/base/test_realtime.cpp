// runPeriodic: every step is at a whole number of periods, and a late step skips periods instead of running in a burst.
#include "base/realtime.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "base/clock.h"

namespace hl {
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

TEST(RequestRealtime, SaysWhyWhatWasRefused) {
  std::thread asking([] {
    const RealtimeGrant grant = requestRealtime(1);
    EXPECT_EQ(grant.why.empty(), grant.fifo && grant.memory_locked);
  });
  asking.join();
}

}  // namespace
}  // namespace hl
