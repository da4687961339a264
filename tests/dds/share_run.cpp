// How a shared world is over lines of several delays and losses: a row of numbers for each, by share_lab.h.
#include <cstdio>
#include <cstdlib>

#include "base/error.h"
#include "dds/share_lab.h"

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10;
  std::printf(
      "delay_ms,loss_percent,staleness_p50_ms,staleness_p99_ms,staleness_max_ms,playout_ms,apart_ms,least_tank_mJ,"
      "moving_"
      "mJ,force_N,steps,missed,timer_missed\n");
  try {
    for (const double delay_ms : {0.0, 10.0, 50.0, 100.0}) {
      for (const double loss_percent : {0.0, 1.0, 5.0}) {
        const hl::test::LabResult r = hl::test::ShareLab({delay_ms, delay_ms / 10, loss_percent}).run(seconds);
        std::printf("%g,%g,%.1f,%.1f,%.1f,%.1f,%.0f,%.3f,%.3f,%.2f,%llu,%llu,%llu\n", delay_ms, loss_percent,
                    r.staleness_p50_ms, r.staleness_p99_ms, r.staleness_max_ms, r.playout_ms, r.apart_ms,
                    1e3 * r.least_tank_J, 1e3 * r.moving_J, r.force_mean_N, static_cast<unsigned long long>(r.steps),
                    static_cast<unsigned long long>(r.missed), static_cast<unsigned long long>(r.timer_missed));
        std::fflush(stdout);
      }
    }
  } catch (const hl::Error& error) {
    std::fprintf(stderr, "share_run: %s\n", error.what());
    return 2;
  }
  return 0;
}
