#include "base/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>

#include "base/clock.h"

namespace hl {

RealtimeGrant requestRealtime(int priority) {
  RealtimeGrant grant;
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  grant.fifo = refused == 0;
  if (refused != 0) grant.why += std::string("no real-time priority (") + std::strerror(refused) + "). ";
  grant.memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (!grant.memory_locked) grant.why += std::string("memory is not locked (") + std::strerror(errno) + "). ";
  return grant;
}

namespace {

void sleepUntil(std::int64_t time_ns) {
  const timespec wake{static_cast<time_t>(time_ns / 1'000'000'000), static_cast<long>(time_ns % 1'000'000'000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
  }
}

}  // namespace

void runPeriodic(std::int64_t period_ns, const std::atomic<bool>& running, LoopCounters& counters,
                 FunctionRef<void(std::int64_t)> step) {
  std::int64_t deadline_ns = monotonicNow_ns() + period_ns;
  while (running.load(std::memory_order_relaxed)) {
    sleepUntil(deadline_ns);
    const std::int64_t late_ns = monotonicNow_ns() - deadline_ns;
    if (late_ns > counters.late_max_ns.load(std::memory_order_relaxed)) {
      counters.late_max_ns.store(late_ns, std::memory_order_relaxed);
    }
    const std::int64_t skipped = late_ns / period_ns;
    if (skipped > 0) {
      counters.deadlines_missed.fetch_add(static_cast<std::uint64_t>(skipped), std::memory_order_relaxed);
      deadline_ns += skipped * period_ns;
    }
    step(deadline_ns);
    counters.steps.fetch_add(1, std::memory_order_relaxed);
    deadline_ns += period_ns;
  }
}

}  // namespace hl
