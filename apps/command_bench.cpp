// hl bench: the time of a tick against the number of primitives, sliding over terrain, as a table and CSV.
#include <fmt/core.h>
#include <fmt/os.h>

#include <cmath>
#include <optional>

#include "base/clock.h"
#include "base/error.h"
#include "base/histogram.h"
#include "builtin.h"
#include "commands.h"
#include "proxy/proxy.h"

namespace hl {

namespace {

constexpr double kSpeed_m_s = 0.15;
constexpr double kPeriod_s = 1e-3;
constexpr double kDepth_m = 0.004;               // of the finger beneath the surface
constexpr std::size_t kBruteForceMost = 10'000;  // beyond, testing every primitive takes minutes

struct BenchOptions {
  double radius = 1e-3;
  int ticks = 20'000;
  int most = 1'000'000;
  std::string csv;
};

struct Row {
  std::string hierarchy;
  std::size_t primitives;
  double build_s;
  Histogram ticks;
  int capped = 0;
};

// A curve that never repeats, at kSpeed over the middle of the terrain, following its height where the proxy is.
Row measure(std::size_t size, HierarchyKind kind, const BenchOptions& options) {
  Row row{kind == HierarchyKind::kSpheres ? "spheres" : "none", 0, 0, {}, 0};
  Model model = makeBuiltinScene("terrain:" + std::to_string(size));
  const std::int64_t build_ns = monotonicNow_ns();
  const auto snapshot = makeSnapshot(std::move(model), kind);
  row.build_s = 1e-9 * static_cast<double>(monotonicNow_ns() - build_ns);
  row.primitives = snapshot->primitives.size();
  const Vec3 centre = snapshot->bounds.centre();
  const double reach = 0.35 * std::min(snapshot->bounds.size().x(), snapshot->bounds.size().z());
  const ProxySettings settings{options.radius, 1000};
  ProxyState state = startProxy(*snapshot, settings, centre + Vec3(0, snapshot->bounds.size().y() + 0.01, 0));
  const int ticks = kind == HierarchyKind::kNone ? std::min(options.ticks, 2000) : options.ticks;
  for (int i = -100; i < ticks; ++i) {  // the first hundred bring the finger down and warm the caches
    const double s = kSpeed_m_s * kPeriod_s * i / reach;
    const Vec3 over = centre + reach * Vec3(std::sin(s), 0, std::sin(1.618 * s) * std::cos(0.3 * s));
    const Vec3 finger(over.x(), std::min(over.y(), state.position.y() - kDepth_m), over.z());
    const std::int64_t start_ns = monotonicNow_ns();
    const TickReport report = tick(state, *snapshot, settings, finger);
    const std::int64_t time_ns = monotonicNow_ns() - start_ns;
    if (i < 0) continue;
    row.ticks.add(static_cast<std::uint64_t>(time_ns));
    row.capped += report.capped ? 1 : 0;
  }
  return row;
}

double us(std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); }

void run(const BenchOptions& options) {
  std::optional<fmt::ostream> csv;
  if (!options.csv.empty()) {
    try {
      csv.emplace(fmt::output_file(options.csv));
    } catch (const std::system_error& error) {
      throw Error("cannot write " + options.csv + ": " + error.what());
    }
    csv->print("hierarchy,primitives,build_s,ticks,p50_us,p99_us,p999_us,max_us,capped\n");
  }
  fmt::print("one tick, sliding at {} m/s over terrain, r = {} m, times in us\n", kSpeed_m_s, options.radius);
  fmt::print("{:<10}{:>11}{:>10}{:>9}{:>9}{:>9}{:>9}{:>8}\n", "hierarchy", "primitives", "build s", "p50", "p99",
             "p99.9", "max", "capped");
  for (const HierarchyKind kind : {HierarchyKind::kSpheres, HierarchyKind::kNone}) {
    for (int size = 1000; size <= options.most; size *= 10) {
      if (kind == HierarchyKind::kNone && static_cast<std::size_t>(size) > kBruteForceMost) break;
      const Row row = measure(static_cast<std::size_t>(size), kind, options);
      const Histogram& t = row.ticks;
      fmt::print("{:<10}{:>11}{:>10.3f}{:>9.2f}{:>9.2f}{:>9.2f}{:>9.2f}{:>8}\n", row.hierarchy, row.primitives,
                 row.build_s, us(t.percentile_ns(0.5)), us(t.percentile_ns(0.99)), us(t.percentile_ns(0.999)),
                 us(t.max_ns()), row.capped);
      std::fflush(stdout);
      if (csv) {
        csv->print("{},{},{:.6f},{},{:.3f},{:.3f},{:.3f},{:.3f},{}\n", row.hierarchy, row.primitives, row.build_s,
                   t.count(), us(t.percentile_ns(0.5)), us(t.percentile_ns(0.99)), us(t.percentile_ns(0.999)),
                   us(t.max_ns()), row.capped);
      }
    }
  }
}

}  // namespace

void addBenchCommand(CLI::App& app) {
  auto* command = app.add_subcommand("bench", "the time of a tick on this machine against the number of primitives");
  auto options = std::make_shared<BenchOptions>();
  command->add_option("--radius", options->radius, "proxy radius in metres")
      ->check(CLI::Validator(checkPositive, "POSITIVE"))
      ->capture_default_str();
  command->add_option("--ticks", options->ticks, "ticks for each size")
      ->check(CLI::Range(100, 100'000'000))
      ->capture_default_str();
  command->add_option("--most", options->most, "largest number of triangles")
      ->check(CLI::Range(1000, 10'000'000))
      ->capture_default_str();
  command->add_option("--csv", options->csv, "also write the table to this file");
  command->callback([options] { run(*options); });
}

}  // namespace hl
