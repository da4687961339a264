#include <memory>
#include <utility>

#include "base/clock.h"
#include "depth_table.h"
#include "surface_bench.h"
#include "surfaces/depth_frame.h"

namespace hl {

namespace {

constexpr std::uint32_t kColumns = 1280, kRows = 720;
constexpr double kOfBefore = 0.5;
constexpr double kDepthRadii_m[] = {1e-3, 2e-3, 5e-3};

std::shared_ptr<const DepthFrame> frameOf(const DepthPicture& picture, const DepthImage* before) {
  auto image = smoothed(picture.grid(), picture.unit_m, picture.camera, before, before != nullptr ? kOfBefore : 0);
  return std::make_shared<const DepthFrame>(std::move(image), frameOfTable());
}

}  // namespace

void benchDepths(SurfaceBench& bench) {
  const DepthPicture picture = pictureOfTable(kColumns, kRows);
  std::int64_t begin_ns = monotonicNow_ns();
  const std::shared_ptr<const DepthFrame> first = frameOf(picture, nullptr);
  BenchSurface surface{"depth:table", static_cast<double>(picture.depths.size())};
  surface.open_s = secondsSince(begin_ns);
  surface.bytes = static_cast<double>(first->image().bytes());
  begin_ns = monotonicNow_ns();
  const std::shared_ptr<const Snapshot> scene = makeSnapshot(alone("depth", frameOf(picture, &first->image())));
  surface.change_ms = 1e3 * secondsSince(begin_ns);
  for (const double radius_m : kDepthRadii_m) bench.measure(surface, *scene, radius_m);
}

}  // namespace hl
