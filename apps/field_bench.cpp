#include "field_bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/machine_memory.h"
#include "fields.h"
#include "io/output_file.h"
#include "scene/scene_model.h"
#include "tick/timing.h"

namespace hl {

namespace {

constexpr std::size_t kLeastField = 10'000, kMostMesh = 1'000'000;

constexpr double kZoomedCells = 4;  // radius of the proxy that is zoomed

struct FieldRow {
  std::size_t triangles = 0;
  const char* form = "";    // "field" or "mesh"
  const char* radius = "";  // "fixed" or "zoomed"
  double radius_m = 0, open_s = 0, bytes = 0;
  bench::Timing ticks;
};

void printRow(const FieldRow& row) {
  fmt::print("{:>12}  {:<6}{:<8}{:>10.4g}{:>9.2f}{:>8.2f}{:>10.2f}{:>10.2f}{:>10.1f}\n", row.triangles, row.form,
             row.radius, 1e3 * row.radius_m, row.open_s, row.bytes, row.ticks.median_us(),
             row.ticks.percentile_us(0.999), row.ticks.max_us());
  std::fflush(stdout);
}

void writeRow(OutputFile& csv, const FieldRow& row) {
  csv.print("{},{},{},{:.6g},{:.4f},{:.3f},{:.3f},{:.3f},{:.3f}\n", row.triangles, row.form, row.radius, row.radius_m,
            row.open_s, row.bytes, row.ticks.median_us(), row.ticks.percentile_us(0.999), row.ticks.max_us());
  csv.flush();
}

Model meshOf(const PrimitiveSource& source) {
  DrawnMesh drawn = source.drawn(std::numeric_limits<std::size_t>::max());
  Model model;
  model.positions = std::move(drawn.positions);
  model.triangles = std::move(drawn.triangles);
  return model;
}

class FieldBench {
 public:
  FieldBench(const FieldBenchOptions& options, OutputFile* csv) : options_(options), csv_(csv) {}

  /// `make` gives the scene; a finger slides over it, with the radius of the options and with one of a few cells.
  template <typename Make>
  void run(const char* form, double cell_m, const Make& make) {
    const std::int64_t begin_ns = monotonicNow_ns();
    const std::shared_ptr<const Snapshot> scene = make();
    FieldRow row;
    row.form = form;
    row.open_s = 1e-9 * static_cast<double>(monotonicNow_ns() - begin_ns);
    row.triangles = scene->primitives;
    row.bytes = static_cast<double>(scene->shape().geometryBytes()) / static_cast<double>(row.triangles);
    slide(*scene, "fixed", options_.radius_m, row);
    slide(*scene, "zoomed", kZoomedCells * cell_m, row);
  }

 private:
  void slide(const Snapshot& scene, const char* radius, double radius_m, FieldRow& row) const {
    ProxySettings settings;
    settings.radius = row.radius_m = radius_m;
    row.radius = radius;
    const bench::Path path =
        bench::planPath(scene, bench::FingerMotion::kSliding, settings, options_.ticks, radius_m / options_.radius_m);
    row.ticks = bench::timeTicks(scene, settings, path, options_.ticks).times.middle();
    printRow(row);
    if (csv_ != nullptr) writeRow(*csv_, row);
  }

  const FieldBenchOptions& options_;
  OutputFile* const csv_;
};

}  // namespace

void runFieldBench(const FieldBenchOptions& options) {
  std::optional<OutputFile> csv;
  if (!options.csv.empty()) {
    csv.emplace(options.csv);
    csv->print("triangles,form,radius,radius_m,open_s,bytes_per_triangle,p50_us,p999_us,worst_us\n");
  }
  fmt::print("{:>12}  {:<6}{:<8}{:>10}{:>9}{:>8}{:>10}{:>10}{:>10}\n", "triangles", "form", "radius", "mm", "open s",
             "bytes", "p50 us", "p99.9 us", "worst us");
  FieldBench bench(options, csv ? &*csv : nullptr);
  for (std::size_t size = std::min(kLeastField, options.most); size <= options.most; size *= 10) {
    if (2 * size > machineMemory_bytes()) throw Error(fmt::format("there is no memory for {} triangles", size));
    const double cell_m = 0.2 / std::sqrt(0.5 * static_cast<double>(size));
    bench.run("field", cell_m, [&] {
      SceneModel scene;
      scene.surfaces.push_back({"field", makeTerrainField(size)});
      return makeSnapshot(std::move(scene));
    });
    if (size > kMostMesh) continue;
    bench.run("mesh", cell_m, [&] { return makeSnapshot(meshOf(*makeTerrainField(size))); });
  }
  if (csv) csv->close();
  fmt::print(
      "\nThe hills of field:terrain:N, 0.2 m across, and the same triangles as a mesh; a finger slides 4 mm beneath\n"
      "the proxy at 0.15 m/s. zoomed: with a radius of four cells, and the finger's motion in proportion. open: to\n"
      "generate the samples and make the scene; bytes: of samples and pyramid, or of mesh and hierarchy, for a\n"
      "triangle. Of each tick the middle one of three times counts.\n");
}

}  // namespace hl
