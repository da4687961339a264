#include "touch/servo_watch.h"

#include <algorithm>
#include <cmath>

#include "base/guarded_thread.h"
#include "base/realtime.h"
#include "control/watchdog.h"

namespace hl {

namespace {

constexpr int kPriority = 85;  // SCHED_FIFO; above the servo, so that one that spins is found
constexpr double kStall_s = 0.050, kStallWithoutRealtime_s = 0.250;
constexpr double kFewestPeriods = 10;

}  // namespace

std::uint32_t ServoWatch::looks(bool real_time, double servo_rate_Hz) {
  const double stall_s = std::max(real_time ? kStall_s : kStallWithoutRealtime_s, kFewestPeriods / servo_rate_Hz);
  return static_cast<std::uint32_t>(std::ceil(1e9 * stall_s / static_cast<double>(kLook_ns)));
}

void ServoWatch::start(std::uint32_t looks) {
  thread_.start("servo watch", [this, looks] { run(looks); });
}

void ServoWatch::stop() { thread_.stop(); }

void ServoWatch::run(std::uint32_t looks) {
  requestRealtime(kPriority);
  Watchdog watchdog(looks);
  runPeriodic(kLook_ns, thread_.running(), counters_, [&](std::int64_t) {
    if (!watchdog.look(servo_.steps.load(std::memory_order_relaxed))) return;
    stalled_.store(true, std::memory_order_release);
    device_.stop();
    guarded(on_stall_);
  });
}

}  // namespace hl
