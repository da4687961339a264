#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "base/clock.h"
#include "phantom.h"
#include "surface_bench.h"
#include "surfaces/iso_surface.h"

namespace hl {

namespace {

constexpr std::uint32_t kMinSide = 64;
constexpr double kVolumeSide_m = 0.16, kBytesOfSample = 3;

double cubed(std::uint32_t side) { return static_cast<double>(side) * side * side; }

// The time of another iso value is that of a scene with it.
void benchIso(SurfaceBench& bench, const SceneSurface& of, BenchSurface surface) {
  const auto& iso = dynamic_cast<const IsoSurface&>(*of.source);
  surface.name += " " + of.name;
  surface.bytes = static_cast<double>(iso.volume()->bytes());
  SceneModel model = alone(of.name, of.source);
  const std::int64_t begin_ns = monotonicNow_ns();
  setIsoValues(model, {iso.iso().value});
  const std::shared_ptr<const Snapshot> scene = makeSnapshot(std::move(model));
  surface.change_ms = 1e3 * secondsSince(begin_ns);
  bench.measure(surface, *scene);
}

}  // namespace

void benchVolumes(SurfaceBench& bench) {
  const auto most = static_cast<double>(bench.options().most);
  std::uint32_t side = kMinSide;
  while (cubed(side) > most) side /= 2;
  for (; cubed(side) <= most; side *= 2) {
    BenchSurface surface{fmt::format("ct:phantom:{}", side), cubed(side), 0, 0};
    needMemory(kBytesOfSample * surface.stored, "the samples of " + surface.name);
    const std::int64_t begin_ns = monotonicNow_ns();
    const SceneModel phantom = makePhantom(side);
    surface.open_s = secondsSince(begin_ns);
    surface.cell_m = kVolumeSide_m / side;
    for (const SceneSurface& iso : phantom.surfaces) benchIso(bench, iso, surface);
  }
}

}  // namespace hl
