#include "base/timer_probe.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "base/clock.h"
#include "base/guarded_thread.h"

namespace hl {

void TimerProbe::run(std::chrono::milliseconds duration) {
  std::atomic<bool> running{true};
  std::thread thread = startThread("timer probe", [&] {
    grant = requestRealtime(kServoPriority, spareCore(0));
    runPeriodic(static_cast<std::int64_t>(1e9 / rate_Hz), running, counters, [&](std::int64_t scheduled_ns) {
      late.add(static_cast<std::uint64_t>(std::max<std::int64_t>(0, monotonicNow_ns() - scheduled_ns)));
    });
  });
  std::this_thread::sleep_for(duration);
  running = false;
  thread.join();
}

}  // namespace hl
