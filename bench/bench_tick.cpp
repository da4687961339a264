// One tick and its two queries, sliding over terrain: both hierarchies against brute force.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "builtin.h"
#include "geometry/queries.h"
#include "proxy/proxy.h"

namespace hl {
namespace {

std::shared_ptr<const Snapshot> terrain(std::int64_t triangles, HierarchyKind kind) {
  return makeSnapshot(makeBuiltinScene("terrain:" + std::to_string(triangles)), kind);
}

void slide(benchmark::State& bench, HierarchyKind kind) {
  const auto snapshot = terrain(bench.range(0), kind);
  const ProxySettings settings{1e-3, 1000};
  ProxyState state = startProxy(*snapshot, settings, Vec3(0.06, 0.05, 0));
  double s = 0;
  for (auto _ : bench) {
    s += 0.15e-3 / 0.06;
    const TickReport report =
        tick(state, *snapshot, settings, Vec3(0.06 * std::cos(s), -0.005, 0.06 * std::sin(1.3 * s)));
    benchmark::DoNotOptimize(report.iterations);
  }
}

void tickOnBvh(benchmark::State& bench) { slide(bench, HierarchyKind::kBvh); }
void tickOnSpheres(benchmark::State& bench) { slide(bench, HierarchyKind::kSpheres); }
void tickOnNone(benchmark::State& bench) { slide(bench, HierarchyKind::kNone); }
BENCHMARK(tickOnBvh)->RangeMultiplier(10)->Range(1'000, 1'000'000);
BENCHMARK(tickOnSpheres)->RangeMultiplier(10)->Range(1'000, 1'000'000);
BENCHMARK(tickOnNone)->RangeMultiplier(10)->Range(1'000, 10'000);

void closestPointOnTriangle(benchmark::State& bench) {
  Primitive triangle;
  makeTriangle(Vec3(0, 0, 0), Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 2e-4), 0, triangle);
  double s = 0;
  for (auto _ : bench) {
    s += 1e-4;
    benchmark::DoNotOptimize(closestPoint(triangle, Vec3(1e-3 * std::sin(s), 5e-4, 1e-3)));
  }
}
BENCHMARK(closestPointOnTriangle);

}  // namespace
}  // namespace hl
