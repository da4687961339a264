#include "surface_bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/machine_memory.h"

namespace hl {

namespace {

constexpr double kZoomedCells = 4;  // radius of the proxy that is zoomed
constexpr double kHolds = 1.5;      // cells: a ball that is smaller may pass between the points of a cloud

std::string orNothing(const std::optional<double>& number, const char* otherwise) {
  return number ? fmt::format("{:.3f}", *number) : otherwise;
}

}  // namespace

SurfaceBench::SurfaceBench(const SurfaceBenchOptions& options) : options_(options) {
  fmt::print("{:<26}{:>12}{:>11}{:>8}{:>10}{:>9}  {:<9}{:>9}{:>10}{:>10}{:>8}\n", "surface", "stored", "MB", "open s",
             "change ms", "r mm", "motion", "p50 us", "p99.9 us", "worst us", "short");
  if (options.csv.empty()) return;
  csv_.emplace(options.csv);
  csv_->print("surface,stored,triangles,bytes,open_s,change_ms,radius_m,motion,p50_us,p999_us,worst_us,out_of_work\n");
}

void SurfaceBench::measure(const BenchSurface& surface, const Snapshot& scene) {
  const bool holds = !surface.cell_m || options_.radius_m >= kHolds * *surface.cell_m;
  if (holds) measure(surface, scene, options_.radius_m);
  if (surface.cell_m) measure(surface, scene, kZoomedCells * *surface.cell_m);
}

void SurfaceBench::measure(const BenchSurface& surface, const Snapshot& scene, double radius_m) {
  using enum bench::FingerMotion;
  for (const auto motion : {kSliding, kTapping, kWandering}) row(surface, scene, radius_m, motion);
}

void SurfaceBench::row(const BenchSurface& surface, const Snapshot& scene, double radius_m,
                       bench::FingerMotion motion) {
  ProxySettings settings;
  settings.radius = radius_m;
  const bench::Path path = bench::planPath(scene, motion, settings, options_.ticks, radius_m / options_.radius_m);
  const bench::TickTimes measured = bench::timeTicks(scene, settings, path, options_.ticks);
  const bench::Timing ticks = measured.times.middle();
  const double p50_us = ticks.median_us(), p999_us = ticks.percentile_us(0.999);
  fmt::print("{:<26}{:>12.4g}{:>11.2f}{:>8.2f}{:>10}{:>9.3f}  {:<9}{:>9.2f}{:>10.2f}{:>10.1f}{:>8}\n", surface.name,
             surface.stored, 1e-6 * surface.bytes, surface.open_s, orNothing(surface.change_ms, "-"), 1e3 * radius_m,
             nameOf(motion), p50_us, p999_us, ticks.max_us(), measured.out_of_work);
  std::fflush(stdout);
  if (!csv_) return;
  csv_->print("{},{:.0f},{},{:.0f},{:.4f},{},{:.6g},{},{:.3f},{:.3f},{:.3f},{}\n", surface.name, surface.stored,
              scene.primitives, surface.bytes, surface.open_s, orNothing(surface.change_ms, ""), radius_m,
              nameOf(motion), p50_us, p999_us, ticks.max_us(), measured.out_of_work);
  csv_->flush();
}

void SurfaceBench::close() {
  if (csv_) csv_->close();
}

void needMemory(double bytes, const std::string& what) {
  if (bytes > static_cast<double>(machineMemory_bytes())) throw Error("there is no memory for " + what);
}

double secondsSince(std::int64_t begin_ns) { return 1e-9 * static_cast<double>(monotonicNow_ns() - begin_ns); }

SceneModel alone(const std::string& name, std::shared_ptr<const PrimitiveSource> source) {
  SceneModel scene;
  scene.surfaces.push_back({name, std::move(source)});
  return scene;
}

void runSurfaceBench(const SurfaceBenchOptions& options) {
  SurfaceBench bench(options);
  for (const SurfaceKind& kind : kSurfaceKinds) {
    if (std::find(options.kinds.begin(), options.kinds.end(), kind.name) != options.kinds.end()) kind.measure(bench);
  }
  bench.close();
  fmt::print(
      "\nGenerated surfaces, as hl touch takes them; a finger slides 4 mm beneath the proxy at 0.15 m/s, taps, or\n"
      "wanders to places of the surface that are drawn at random, with the radius of the options, and with one of\n"
      "four cells and its motion in proportion. stored: samples or points;\n"
      "MB: of these and of the index; open: to generate them and make the scene; change: to make a scene with another\n"
      "iso value, or with the next frame of the camera. Of each tick the middle one of three times counts. short:\n"
      "ticks that ended at a valid place as they had done all that one tick may.\n");
}

}  // namespace hl
