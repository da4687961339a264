#include "sweep_progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

#include "base/clock.h"
#include "fleet/fleet_texts.h"
#include "standard_streams.h"

namespace hl {

SweepProgress::SweepProgress(std::size_t tasks)
    : tasks_(tasks), begin_ns_(monotonicNow_ns()), terminal_(isatty(STDERR_FILENO) == 1) {}

double SweepProgress::seconds() const { return 1e-9 * static_cast<double>(monotonicNow_ns() - begin_ns_); }

void SweepProgress::report() {
  constexpr double kOnTerminal_s = 0.2, kElsewhere_s = 10;
  const double now_s = seconds();
  if (now_s - reported_s_ < (terminal_ ? kOnTerminal_s : kElsewhere_s)) return;
  reported_s_ = now_s;
  const std::string line = fleetProgressText(done_, tasks_, now_s);
  terminal_ ? tell("\r{}\x1b[K", line) : tell("{}\n", line);
  std::fflush(stderr);
}

double SweepProgress::end() {
  if (terminal_) tell("\r\x1b[K");
  return seconds();
}

}  // namespace hl
