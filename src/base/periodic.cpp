#include "base/periodic.h"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "base/clock.h"

namespace hl {

namespace {

constexpr std::int64_t kUsageEvery_ns = 1'000'000'000;

void sleepUntil(std::int64_t time_ns) {
  const timespec wake{static_cast<time_t>(time_ns / 1'000'000'000), static_cast<long>(time_ns % 1'000'000'000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
  }
}

void add(std::atomic<std::uint64_t>& count, std::uint64_t more) { count.fetch_add(more, std::memory_order_relaxed); }

// What the kernel counts of this thread, asked between steps.
class Usage {
 public:
  explicit Usage(LoopCounters& counters) : counters_(counters), begin_(now()) {}

  // The thread has waited for `deadlines` deadlines; each is a wait that the kernel counts.
  void store(std::uint64_t deadlines) {
    const rusage usage = now();
    const auto since = [](long count, long before) { return static_cast<std::uint64_t>(std::max(0L, count - before)); };
    counters_.page_faults = since(usage.ru_minflt + usage.ru_majflt, begin_.ru_minflt + begin_.ru_majflt);
    counters_.preempted = since(usage.ru_nivcsw, begin_.ru_nivcsw);
    const std::uint64_t waits = since(usage.ru_nvcsw, begin_.ru_nvcsw);
    counters_.waits = waits - std::min(waits, deadlines);
  }

 private:
  static rusage now() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage;
  }

  LoopCounters& counters_;
  const rusage begin_;
};

void countDuty(LoopCounters& counters, std::int64_t work_ns, std::int64_t period_ns) {
  const double duty = static_cast<double>(work_ns) / static_cast<double>(period_ns);
  const auto bound = std::lower_bound(kDutyBounds.begin(), kDutyBounds.end(), duty);
  add(counters.duty[static_cast<std::size_t>(bound - kDutyBounds.begin())], 1);
}

}  // namespace

void runPeriodic(std::int64_t period_ns, const std::atomic<bool>& running, LoopCounters& counters,
                 FunctionRef<void(std::int64_t)> step) {
  Usage usage(counters);
  std::uint64_t deadlines = 0;
  std::int64_t deadline_ns = monotonicNow_ns() + period_ns;
  std::int64_t usage_ns = deadline_ns + kUsageEvery_ns;
  while (running.load(std::memory_order_relaxed)) {
    sleepUntil(deadline_ns);
    ++deadlines;
    const std::int64_t begin_ns = monotonicNow_ns();
    const std::int64_t late_ns = begin_ns - deadline_ns;
    if (late_ns > counters.late_max_ns.load(std::memory_order_relaxed)) {
      counters.late_max_ns.store(late_ns, std::memory_order_relaxed);
    }
    const std::int64_t skipped = late_ns / period_ns;
    if (skipped > 0) {
      add(counters.deadlines_missed, static_cast<std::uint64_t>(skipped));
      deadline_ns += skipped * period_ns;
    }
    step(deadline_ns);
    add(counters.steps, 1);
    const std::int64_t end_ns = monotonicNow_ns();
    countDuty(counters, end_ns - begin_ns, period_ns);
    if (end_ns >= usage_ns) {
      usage.store(deadlines);
      usage_ns = end_ns + kUsageEvery_ns;
    }
    deadline_ns += period_ns;
  }
  usage.store(deadlines);
}

}  // namespace hl
