#include "doctor_machine.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/timer_probe.h"
#include "touch/servo_rate.h"

namespace hl {

namespace {

constexpr auto kMeasure = std::chrono::seconds(1);

void print(const TimerResult& timer) {
  const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
  fmt::print("{:<20}late by {:.0f} us median, {:.0f} us at p99.9, {:.0f} us at most; {} of {} missed\n",
             fmt::format("timer at {:g} kHz:", 1e-3 * timer.rate_Hz), us(timer.late_median_ns), us(timer.late_p999_ns),
             us(timer.late_max_ns), timer.deadlines_missed, timer.steps);
}

}  // namespace

double MachineExamination::servoRate_Hz() const {
  double highest_Hz = 0;
  for (const TimerResult& timer : timers)
    if (timer.holds) highest_Hz = timer.rate_Hz;
  return highest_Hz;
}

MachineExamination examineMachine() {
  MachineExamination machine;
  lockProcessMemory();
  machine.cores = std::thread::hardware_concurrency();
  for (const double rate_Hz : kServoRates_Hz) {
    TimerProbe timer;
    timer.rate_Hz = rate_Hz;
    timer.run(kMeasure);
    machine.timers.push_back({rate_Hz, timer.late.percentile_ns(0.5), timer.late.percentile_ns(0.999),
                              timer.late.max_ns(), timer.counters.steps, timer.counters.deadlines_missed,
                              timer.holds()});
    machine.grant = timer.grant;
  }
  return machine;
}

void print(const MachineExamination& machine) {
  fmt::print("cores:              {}\n", machine.cores);
  for (const TimerResult& timer : machine.timers) print(timer);
  if (machine.servoRate_Hz() == 0)
    fmt::print("servo rate:         1 kHz is more than this machine holds just now: late by over half a period\n");
  else
    fmt::print("servo rate:         up to {:g} kHz: late by less than half a period in 999 of 1000 steps\n",
               1e-3 * machine.servoRate_Hz());
  const RealtimeGrant& grant = machine.grant;
  fmt::print("real-time priority: {}\n", grant.fifo ? "granted (SCHED_FIFO)" : "refused");
  fmt::print("locked memory:      {}\n", grant.memory_locked ? "granted" : "refused");
  fmt::print("core of its own:    {}\n",
             grant.core < 0 ? "none to spare: a process needs four, or one that the kernel keeps free (isolcpus)"
                            : fmt::format("number {}", grant.core));
}

}  // namespace hl
