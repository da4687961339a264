#include "volume_bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/clock.h"
#include "base/error.h"
#include "base/machine_memory.h"
#include "io/output_file.h"
#include "phantom.h"
#include "surfaces/iso_surface.h"
#include "tick/timing.h"

namespace hl {

namespace {

constexpr std::uint32_t kLeastSide = 128;

struct VolumeRow {
  std::uint32_t side = 0;
  const char* surface = "";
  std::uint64_t triangles = 0;
  double open_s = 0, megabytes = 0, iso_ms = 0;
  bench::Timing ticks;
};

double secondsSince(std::int64_t begin_ns) { return 1e-9 * static_cast<double>(monotonicNow_ns() - begin_ns); }

void print(const VolumeRow& row) {
  fmt::print("{:>6}  {:<8}{:>12}{:>9.2f}{:>9.1f}{:>9.3f}{:>9.2f}{:>9.2f}{:>9.1f}\n", row.side, row.surface,
             row.triangles, row.open_s, row.megabytes, row.iso_ms, row.ticks.median_us(),
             row.ticks.percentile_us(0.999), row.ticks.max_us());
  std::fflush(stdout);
}

void write(OutputFile& csv, const VolumeRow& row) {
  csv.print("{},{},{},{:.4f},{:.3f},{:.4f},{:.3f},{:.3f},{:.3f}\n", row.side, row.surface, row.triangles, row.open_s,
            row.megabytes, row.iso_ms, row.ticks.median_us(), row.ticks.percentile_us(0.999), row.ticks.max_us());
  csv.flush();
}

// A finger slides over one surface of the phantom; the time of another iso value is that of a scene with it.
VolumeRow measured(const SceneModel& phantom, std::size_t number, const VolumeBenchOptions& options) {
  const SceneSurface& surface = phantom.surfaces[number];
  const auto& iso = dynamic_cast<const IsoSurface&>(*surface.source);
  VolumeRow row;
  row.side = iso.volume()->grid.side(0);
  row.surface = surface.name.c_str();
  row.megabytes = 1e-6 * static_cast<double>(iso.volume()->bytes());
  SceneModel alone;
  alone.surfaces.push_back(surface);
  const std::int64_t begin_ns = monotonicNow_ns();
  setIsoValues(alone, {iso.iso().value});
  const std::shared_ptr<const Snapshot> scene = makeSnapshot(std::move(alone));
  row.iso_ms = 1e3 * secondsSince(begin_ns);
  row.triangles = scene->primitives;
  ProxySettings settings;
  settings.radius = options.radius_m;
  const bench::Path path = bench::planPath(*scene, bench::FingerMotion::kSliding, settings, options.ticks);
  row.ticks = bench::timeTicks(*scene, settings, path, options.ticks).times.middle();
  return row;
}

}  // namespace

void runVolumeBench(const VolumeBenchOptions& options) {
  std::optional<OutputFile> csv;
  if (!options.csv.empty()) {
    csv.emplace(options.csv);
    csv->print("side,surface,triangles,open_s,megabytes,iso_ms,p50_us,p999_us,worst_us\n");
  }
  fmt::print("{:>6}  {:<8}{:>12}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "side", "surface", "triangles", "open s", "MB",
             "iso ms", "p50 us", "p99.9 us", "worst us");
  for (std::uint32_t side = std::min(kLeastSide, options.most); side <= options.most; side *= 2) {
    if (3 * std::uint64_t{side} * side * side > machineMemory_bytes())
      throw Error(fmt::format("there is no memory for a volume of {}^3 samples", side));
    const std::int64_t begin_ns = monotonicNow_ns();
    const SceneModel phantom = makePhantom(side);
    const double open_s = secondsSince(begin_ns);
    for (std::size_t number = 0; number < phantom.surfaces.size(); ++number) {
      VolumeRow row = measured(phantom, number, options);
      row.open_s = open_s;
      print(row);
      if (csv) write(*csv, row);
    }
  }
  if (csv) csv->close();
  fmt::print(
      "\nThe phantom of ct:phantom:N, 160 mm across, and a finger that slides 4 mm beneath the proxy at 0.15 m/s.\n"
      "open: to generate the samples and bound them; MB: of samples and bounds, which all surfaces share; iso: to "
      "make\n"
      "a scene with another iso value. Of each tick the middle one of three times counts.\n");
}

}  // namespace hl
