// hl doctor: what this machine grants, and which devices are present.
#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "base/realtime.h"
#include "base/timer_probe.h"
#include "commands.h"
#include "device/open_device.h"
#include "serving.h"
#include "touch/servo_rate.h"

namespace hl {

namespace {

constexpr auto kMeasure = std::chrono::seconds(1);

// How many there are, and the newest: their names begin with the time.
void printBlackBoxes() {
  const std::string folder = defaultBlackBoxFolder();
  std::string newest;
  std::size_t count = 0;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() != ".hlr") continue;
    ++count;
    newest = std::max(newest, entry.path().string());
  }
  fmt::print("faults:             ");
  if (count == 0)
    fmt::print("no black box in {}\n", folder);
  else
    fmt::print("{} black boxes; hl replay {}\n", count, newest);
}

void print(const TimerProbe& timer) {
  const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
  fmt::print("{:<20}late by {:.0f} us median, {:.0f} us at p99.9, {:.0f} us at most; {} of {} missed\n",
             fmt::format("timer at {:g} kHz:", 1e-3 * timer.rate_Hz), us(timer.late.percentile_ns(0.5)),
             us(timer.late.percentile_ns(0.999)), us(timer.late.max_ns()), timer.counters.deadlines_missed.load(),
             timer.counters.steps.load());
}

// Prints what the machine does at each rate; returns what it granted.
RealtimeGrant examineTimer() {
  double highest_Hz = 0;
  RealtimeGrant grant;
  for (const double rate_Hz : kServoRates_Hz) {
    TimerProbe timer;
    timer.rate_Hz = rate_Hz;
    timer.run(kMeasure);
    print(timer);
    grant = timer.grant;
    if (timer.holds()) highest_Hz = rate_Hz;
  }
  if (highest_Hz == 0)
    fmt::print("servo rate:         1 kHz is more than this machine holds just now: late by over half a period\n");
  else
    fmt::print("servo rate:         up to {:g} kHz: late by less than half a period in 999 of 1000 steps\n",
               1e-3 * highest_Hz);
  return grant;
}

void examine() {
  lockProcessMemory();
  fmt::print("cores:              {}\n", std::thread::hardware_concurrency());
  const RealtimeGrant grant = examineTimer();
  fmt::print("real-time priority: {}\n", grant.fifo ? "granted (SCHED_FIFO)" : "refused");
  fmt::print("locked memory:      {}\n", grant.memory_locked ? "granted" : "refused");
  fmt::print("core of its own:    {}\n",
             grant.core < 0 ? "none to spare: a process needs four, or one that the kernel keeps free (isolcpus)"
                            : fmt::format("number {}", grant.core));
  for (const char* head = "devices:"; const DevicePresence& device : findDevices()) {
    fmt::print("{:<20}{:<7}{}\n", head, device.kind, device.text);
    head = "";
  }
  printBlackBoxes();
  if (!grant.fifo || !grant.memory_locked) {
    fmt::print(
        "advice:             let your user have real time: in /etc/security/limits.conf add\n"
        "                      @audio - rtprio 95\n"
        "                      @audio - memlock unlimited\n"
        "                    put the user into the group audio, and log in again. HL works without, less evenly.\n");
  }
}

}  // namespace

void addDoctorCommand(CLI::App& app) {
  auto* command =
      app.add_subcommand("doctor", "what this machine grants (priority, memory, timer) and which devices are present");
  command->callback(examine);
}

}  // namespace hl
