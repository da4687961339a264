#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "base/clock.h"
#include "clouds.h"
#include "surface_bench.h"

namespace hl {

namespace {

constexpr std::size_t kMinCloud = 10'000;
constexpr double kBytesOfPoint = 48;

}  // namespace

void benchClouds(SurfaceBench& bench) {
  const std::size_t most = bench.options().most;
  for (std::size_t size = std::min(kMinCloud, most); size <= most; size *= 10) {
    BenchSurface surface{fmt::format("points:terrain:{}", size), static_cast<double>(size), 0, 0};
    needMemory(kBytesOfPoint * surface.stored, fmt::format("{} points", size));
    const std::int64_t begin_ns = monotonicNow_ns();
    const std::shared_ptr<const PointCloud> cloud = makeTerrainCloud(size);
    surface.open_s = secondsSince(begin_ns);
    surface.bytes = static_cast<double>(cloud->points()->bytes());
    surface.cell_m = cloud->points()->usualSpacing();
    bench.measure(surface, *makeSnapshot(alone("cloud", cloud)));
    surface.name = fmt::format("surfels:terrain:{}", size);
    const auto surfels =
        std::make_shared<const PointCloud>(cloud->points(), cloud->frame(), CloudLook{CloudForm::kSurfels});
    bench.measure(surface, *makeSnapshot(alone("cloud", surfels)));
  }
}

}  // namespace hl
