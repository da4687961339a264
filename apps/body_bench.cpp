#include "body_bench.h"

#include <fmt/core.h>

#include <optional>

#include "cubes/body_suite.h"
#include "io/output_file.h"

namespace hl {

namespace {

void printBodyRow(const bench::BodyRow& row) {
  fmt::print("{:<13}{:<11}{:>10.1f}{:>10.1f}{:>10.1f}{:>12.3g}{:>12.3g}{:>10.2g}", row.scene, row.engine,
             row.times.median_us(), row.times.percentile_us(0.999), row.times.mean_us(), 1e3 * row.gained_J,
             1e3 * row.overlap_m, 1e3 * row.speed_m_s);
  if (row.force_N > 0) fmt::print("{:>10.4f}{:>10.1e}", row.force_N, row.ripple_N);
  fmt::print("\n");
  std::fflush(stdout);
}

void writeBodyRow(OutputFile& csv, const bench::BodyRow& row) {
  csv.print("{},{},{},{:.3f},{:.3f},{:.3f},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.scene, row.engine,
            row.times.count(), row.times.median_us(), row.times.percentile_us(0.999), row.times.mean_us(), row.gained_J,
            row.overlap_m, row.speed_m_s, row.force_N, row.ripple_N);
  csv.flush();
}

}  // namespace

void runBodyBench(bool peers, const std::string& csv) {
  std::optional<OutputFile> file;
  if (!csv.empty()) {
    file.emplace(csv);
    file->print("scene,engine,steps,p50_us,p999_us,mean_us,gained_J,overlap_m,speed_m_s,force_N,ripple_N\n");
  }
  fmt::print("{:<13}{:<11}{:>10}{:>10}{:>10}{:>12}{:>12}{:>10}{:>10}{:>10}\n", "scene", "engine", "p50 us", "p99.9 us",
             "mean us", "gained mJ", "overlap mm", "mm/s", "force N", "ripple N");
  bench::runBodySuite(peers, [&](const bench::BodyRow& row) {
    printBodyRow(row);
    if (file) writeBodyRow(*file, row);
  });
  if (file) file->close();
  fmt::print(
      "\n3000 steps of 1 ms, cubes of 40 mm and 100 g; of each step the thread's own processor time. gained: by how "
      "much\n"
      "the energy of the cubes rises, step by step, where nothing gives them any; overlap, mm/s: how deep two cubes, "
      "or\n"
      "one and the floor or a wall, are one in the other at the end, and the fastest cube then. pushed: by a finger "
      "on\n"
      "1000 N/m at 10 mm/s, friction 0.4: the force must be 0.3924 N; force, ripple: mean and peak to peak of the "
      "last\n"
      "500 steps.\n");
}

}  // namespace hl
