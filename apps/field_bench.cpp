#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/clock.h"
#include "fields.h"
#include "surface_bench.h"

namespace hl {

namespace {

constexpr std::size_t kMinField = 10'000, kMaxFieldMesh = 1'000'000;
constexpr double kFieldSide_m = 0.2, kBytesOfTriangle = 2;

// The same triangles as a mesh.
Model meshOf(const PrimitiveSource& source) {
  DrawnMesh drawn = source.drawn(std::numeric_limits<std::size_t>::max());
  Model model;
  model.positions = std::move(drawn.positions);
  model.triangles = std::move(drawn.triangles);
  return model;
}

template <typename Make>
void benchField(SurfaceBench& bench, BenchSurface surface, const Make& make) {
  const std::int64_t begin_ns = monotonicNow_ns();
  const std::shared_ptr<const Snapshot> scene = make();
  surface.open_s = secondsSince(begin_ns);
  surface.bytes = static_cast<double>(scene->shape().geometryBytes());
  bench.measure(surface, *scene);
}

}  // namespace

void benchFields(SurfaceBench& bench) {
  const std::size_t most = bench.options().most;
  for (std::size_t size = std::min(kMinField, most); size <= most; size *= 10) {
    const auto triangles = static_cast<double>(size);
    needMemory(kBytesOfTriangle * triangles, fmt::format("a field of {} triangles", size));
    BenchSurface surface{fmt::format("field:terrain:{}", size), 0.5 * triangles, 0, 0};
    surface.cell_m = kFieldSide_m / std::sqrt(surface.stored);
    benchField(bench, surface, [&] { return makeSnapshot(alone("field", makeTerrainField(size))); });
    if (size > kMaxFieldMesh) continue;
    surface.name += " as mesh";
    benchField(bench, surface, [&] { return makeSnapshot(meshOf(*makeTerrainField(size))); });
  }
}

}  // namespace hl
