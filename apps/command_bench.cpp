// hl bench: the time of a tick against the number of primitives, sliding over terrain, as a table and CSV.
#include <fmt/core.h>
#include <fmt/os.h>

#include <array>
#include <cmath>
#include <cstdint>
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

// What the surface does beside holding the proxy off.
enum class Feel : std::uint8_t { kPlain, kShading, kFriction, kEverything };
constexpr std::array<Feel, 4> kFeels{Feel::kPlain, Feel::kShading, Feel::kFriction, Feel::kEverything};
constexpr std::array<const char*, 4> kFeelNames{"plain", "shading", "friction", "everything"};

// Everything: shading, both frictions, viscosity, and textures of stiffness, static friction and height.
void setFeel(Model& model, Feel feel) {
  Material& material = model.materials[0];
  if (feel == Feel::kShading || feel == Feel::kEverything) material.smooth = true;
  if (feel == Feel::kFriction || feel == Feel::kEverything) {
    material.static_friction = 0.5;
    material.dynamic_friction = 0.3;
    material.viscosity_Ns_m = 2;
  }
  if (feel != Feel::kEverything) return;
  model.textures = {makeTexture("noise", 64), makeTexture("checker", 64), makeTexture("sine", 64)};
  material.textureOf(Quantity::kStiffness) = {0, 0.5, 1};
  material.textureOf(Quantity::kStaticFriction) = {1, 0.3, 0.6};
  material.textureOf(Quantity::kHeight) = {2, 0, 1e-4};
}

struct Row {
  std::string hierarchy, surface;
  std::size_t primitives;
  double build_s;      // of the whole snapshot
  double index_ns;     // to build its hierarchy alone, and
  double index_bytes;  // its memory, each for one primitive
  Histogram ticks;
  int capped = 0;
  std::int64_t total_ns = 0;
};

void measureIndex(const Shape& shape, HierarchyKind kind, Row& row) {
  const auto primitives = static_cast<double>(row.primitives);
  const std::int64_t start_ns = monotonicNow_ns();
  const auto index = makeIndex(shape.primitives, kind);
  row.index_ns = static_cast<double>(monotonicNow_ns() - start_ns) / primitives;
  row.index_bytes = static_cast<double>(index->stats().bytes) / primitives;
}

// A curve that never repeats, at kSpeed over the middle of the terrain, following its height where the proxy is.
Row measure(std::size_t size, HierarchyKind kind, Feel feel, const BenchOptions& options) {
  Row row{nameOf(kind), kFeelNames[static_cast<std::size_t>(feel)], 0, 0, 0, 0, {}};
  Model model = makeBuiltinScene("terrain:" + std::to_string(size));
  setFeel(model, feel);
  const std::int64_t build_ns = monotonicNow_ns();
  const auto snapshot = makeSnapshot(std::move(model), kind);
  row.build_s = 1e-9 * static_cast<double>(monotonicNow_ns() - build_ns);
  row.primitives = snapshot->primitives;
  measureIndex(snapshot->shape(), kind, row);
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
    row.total_ns += time_ns;
    row.capped += report.capped ? 1 : 0;
  }
  return row;
}

double us(std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); }

std::optional<fmt::ostream> openCsv(const std::string& name) {
  if (name.empty()) return {};
  try {
    std::optional<fmt::ostream> csv(fmt::output_file(name));
    csv->print("hierarchy,surface,primitives,build_s,index_ns,index_bytes,ticks,p50_us,p99_us,p999_us,max_us,capped\n");
    return csv;
  } catch (const std::system_error& error) {
    throw Error("cannot write " + name + ": " + error.what());
  }
}

void print(const Row& row, double ratio, std::optional<fmt::ostream>& csv) {
  const Histogram& t = row.ticks;
  const double p50 = us(t.percentile_ns(0.5)), p99 = us(t.percentile_ns(0.99)), p999 = us(t.percentile_ns(0.999));
  fmt::print("{:<10}{:<12}{:>11}{:>10.3f}{:>8.0f}{:>7.0f}{:>9.2f}{:>9.2f}{:>9.2f}{:>9.2f}{:>8}{:>8.2f}\n",
             row.hierarchy, row.surface, row.primitives, row.build_s, row.index_ns, row.index_bytes, p50, p99, p999,
             us(t.max_ns()), row.capped, ratio);
  std::fflush(stdout);
  if (!csv) return;
  csv->print("{},{},{},{:.6f},{:.1f},{:.1f},{},{:.3f},{:.3f},{:.3f},{:.3f},{}\n", row.hierarchy, row.surface,
             row.primitives, row.build_s, row.index_ns, row.index_bytes, t.count(), p50, p99, p999, us(t.max_ns()),
             row.capped);
}

void run(const BenchOptions& options) {
  std::optional<fmt::ostream> csv = openCsv(options.csv);
  fmt::print(
      "one tick, sliding at {} m/s over terrain, r = {} m, times in us; ratio: mean time to that of plain;\n"
      "build s: of the scene; ns and bytes: to build the hierarchy alone and its memory, for one primitive\n",
      kSpeed_m_s, options.radius);
  fmt::print("{:<10}{:<12}{:>11}{:>10}{:>8}{:>7}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8}\n", "hierarchy", "surface", "primitives",
             "build s", "ns", "bytes", "p50", "p99", "p99.9", "max", "capped", "ratio");
  for (const HierarchyKind kind : {HierarchyKind::kBvh, HierarchyKind::kSpheres, HierarchyKind::kNone}) {
    for (int size = 1000; size <= options.most; size *= 10) {
      if (kind == HierarchyKind::kNone && static_cast<std::size_t>(size) > kBruteForceMost) break;
      double plain_ns = 0;
      for (const Feel feel : kFeels) {
        if (kind == HierarchyKind::kNone && feel != Feel::kPlain) break;
        const Row row = measure(static_cast<std::size_t>(size), kind, feel, options);
        const double mean_ns = static_cast<double>(row.total_ns) / static_cast<double>(row.ticks.count());
        if (feel == Feel::kPlain) plain_ns = mean_ns;
        print(row, mean_ns / plain_ns, csv);
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
