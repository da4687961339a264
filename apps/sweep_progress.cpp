#include "sweep_progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

#include "base/clock.h"

namespace hl {

namespace {

// "2 h 5 min", "3 min", "40 s".
std::string timeInWords(double seconds) {
  constexpr double kMinute_s = 60, kHour_s = 3600;
  if (seconds < 2 * kMinute_s) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour_s) return fmt::format("{:.0f} min", seconds / kMinute_s);
  return fmt::format("{:.1f} h", seconds / kHour_s);
}

}  // namespace

std::string sweepProgressLine(std::size_t done, std::size_t all, double seconds) {
  const std::string count = fmt::format("{} of {} tasks", done, all);
  if (done == 0 || !(seconds > 0)) return count;
  const double rate = static_cast<double>(done) / seconds;
  return fmt::format("{}, {:.3g} a second, {} left", count, rate, timeInWords(static_cast<double>(all - done) / rate));
}

SweepProgress::SweepProgress(std::size_t tasks)
    : tasks_(tasks), begin_ns_(monotonicNow_ns()), terminal_(isatty(STDERR_FILENO) == 1) {}

double SweepProgress::seconds() const { return 1e-9 * static_cast<double>(monotonicNow_ns() - begin_ns_); }

void SweepProgress::tell() {
  constexpr double kOnTerminal_s = 0.2, kElsewhere_s = 10;
  const double now_s = seconds();
  if (now_s - told_s_ < (terminal_ ? kOnTerminal_s : kElsewhere_s)) return;
  told_s_ = now_s;
  const std::string line = sweepProgressLine(done_, tasks_, now_s);
  terminal_ ? fmt::print(stderr, "\r{}\x1b[K", line) : fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
}

double SweepProgress::end() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
  return seconds();
}

}  // namespace hl
