#include "cloud_bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/clock.h"
#include "base/error.h"
#include "base/machine_memory.h"
#include "clouds.h"
#include "io/output_file.h"
#include "scene/scene_model.h"
#include "tick/timing.h"

namespace hl {

namespace {

constexpr std::size_t kLeastPoints = 10'000, kBytesToMake = 48;

struct CloudRow {
  std::size_t points = 0;
  const char *form = "", *motion = "";
  double spacing_mm = 0, radius_mm = 0, open_s = 0, bytes = 0;
  bench::Timing ticks;
};

void printRow(const CloudRow& row) {
  fmt::print("{:>11}  {:<8}{:<9}{:>9.4f}{:>8.3f}{:>8.2f}{:>7.2f}{:>9.2f}{:>10.2f}{:>10.1f}\n", row.points, row.form,
             row.motion, row.spacing_mm, row.radius_mm, row.open_s, row.bytes, row.ticks.median_us(),
             row.ticks.percentile_us(0.999), row.ticks.max_us());
  std::fflush(stdout);
}

void writeRow(OutputFile& csv, const CloudRow& row) {
  csv.print("{},{},{},{:.6f},{:.6f},{:.4f},{:.4f},{:.3f},{:.3f},{:.3f}\n", row.points, row.form, row.motion,
            row.spacing_mm, row.radius_mm, row.open_s, row.bytes, row.ticks.median_us(), row.ticks.percentile_us(0.999),
            row.ticks.max_us());
  csv.flush();
}

class CloudBench {
 public:
  CloudBench(const CloudBenchOptions& options, OutputFile* csv) : options_(options), csv_(csv) {}

  void run(std::size_t points) const {
    const std::int64_t begin_ns = monotonicNow_ns();
    const std::shared_ptr<const PointCloud> cloud = makeTerrainCloud(points);
    CloudRow row;
    row.open_s = 1e-9 * static_cast<double>(monotonicNow_ns() - begin_ns);
    row.points = cloud->points()->size();
    row.bytes = static_cast<double>(cloud->points()->bytes()) / static_cast<double>(row.points);
    row.spacing_mm = 1e3 * cloud->points()->usualSpacing();
    for (const CloudForm form : {CloudForm::kPoints, CloudForm::kSurfels}) {
      row.form = form == CloudForm::kPoints ? "points" : "surfels";
      SceneModel scene;
      scene.surfaces.push_back(
          {"cloud", std::make_shared<const PointCloud>(cloud->points(), cloud->frame(), CloudLook{form})});
      const auto snapshot = makeSnapshot(std::move(scene));
      slide(*snapshot, options_.radius_m, row);
      slide(*snapshot, kZoomedSpacings * 1e-3 * row.spacing_mm, row);
    }
  }

 private:
  static constexpr double kZoomedSpacings = 4;

  // A ball that sinks through its points feels nothing there: such rows are left out.
  void slide(const Snapshot& scene, double radius_m, CloudRow& row) const {
    constexpr double kHolds = 1.5;  // spacings
    if (1e3 * radius_m < kHolds * row.spacing_mm) return;
    ProxySettings settings;
    settings.radius = radius_m;
    row.radius_mm = 1e3 * radius_m;
    for (const bench::FingerMotion motion : {bench::FingerMotion::kSliding, bench::FingerMotion::kTapping}) {
      row.motion = motion == bench::FingerMotion::kSliding ? "sliding" : "tapping";
      const bench::Path path = bench::planPath(scene, motion, settings, options_.ticks, radius_m / options_.radius_m);
      row.ticks = bench::timeTicks(scene, settings, path, options_.ticks).times.middle();
      printRow(row);
      if (csv_ != nullptr) writeRow(*csv_, row);
    }
  }

  const CloudBenchOptions& options_;
  OutputFile* const csv_;
};

}  // namespace

void runCloudBench(const CloudBenchOptions& options) {
  std::optional<OutputFile> csv;
  if (!options.csv.empty()) {
    csv.emplace(options.csv);
    csv->print("points,form,motion,spacing_mm,radius_mm,open_s,bytes_per_point,p50_us,p999_us,worst_us\n");
  }
  fmt::print("{:>11}  {:<8}{:<9}{:>9}{:>8}{:>8}{:>7}{:>9}{:>10}{:>10}\n", "points", "form", "motion", "apart mm",
             "r mm", "open s", "bytes", "p50 us", "p99.9 us", "worst us");
  const CloudBench bench(options, csv ? &*csv : nullptr);
  for (std::size_t points = std::min(kLeastPoints, options.most); points <= options.most; points *= 10) {
    if (kBytesToMake * points > machineMemory_bytes())
      throw Error(fmt::format("there is no memory for {} points", points));
    bench.run(points);
  }
  if (csv) csv->close();
  fmt::print(
      "\nThe hills of points:terrain:N, 0.2 m across, points at random places. Each with the radius of the options "
      "and\n"
      "one of four spacings, the finger's motion in proportion. open: to generate the points, order them and find\n"
      "their normals; bytes: of points, normals and bounds, for a point. Of each tick the middle one of three times\n"
      "counts.\n");
}

}  // namespace hl
