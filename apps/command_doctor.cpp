// hl doctor: what this machine grants, and which devices are present.
#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "base/clock.h"
#include "base/histogram.h"
#include "base/realtime.h"
#include "commands.h"
#include "device/open_device.h"
#include "serving.h"

namespace hl {

namespace {

constexpr int kPriority = 80;
constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr auto kMeasure = std::chrono::seconds(2);

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

void examine() {
  std::atomic<bool> running{true};
  LoopCounters counters;
  Histogram late;
  RealtimeGrant grant;
  std::thread timer([&] {
    grant = requestRealtime(kPriority);
    runPeriodic(kPeriod_ns, running, counters, [&](std::int64_t scheduled_ns) {
      late.add(static_cast<std::uint64_t>(std::max<std::int64_t>(0, monotonicNow_ns() - scheduled_ns)));
    });
  });
  std::this_thread::sleep_for(kMeasure);
  running = false;
  timer.join();
  fmt::print("cores:              {}\n", std::thread::hardware_concurrency());
  fmt::print("real-time priority: {}\n", grant.fifo ? "granted (SCHED_FIFO)" : "refused");
  fmt::print("locked memory:      {}\n", grant.memory_locked ? "granted" : "refused");
  fmt::print("timer at 1 kHz:     late by {:.0f} us median, {:.0f} us at p99.9, {:.0f} us at most; {} of {} missed\n",
             1e-3 * static_cast<double>(late.percentile_ns(0.5)), 1e-3 * static_cast<double>(late.percentile_ns(0.999)),
             1e-3 * static_cast<double>(late.max_ns()), counters.deadlines_missed.load(), counters.steps.load());
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
