#include <memory>
#include <utility>

#include "base/clock.h"
#include "depth_table.h"
#include "surface_bench.h"
#include "surfaces/depth_frame.h"

namespace hl {

namespace {

constexpr double kSmoothing = 0.5;
constexpr double kRadii_m[] = {1e-3, 2e-3, 5e-3};

// The time from the camera's next image to a scene with it.
double nextFrame_ms(const DepthFrame& before) {
  const DepthImage& image = before.image();
  const std::int64_t begin_ns = monotonicNow_ns();
  auto next = smoothed(*image.grid, 1, image.camera, &image, kSmoothing);
  const auto scene = makeSnapshot(alone("depth", std::make_shared<const DepthFrame>(std::move(next), before.frame())));
  return 1e3 * secondsSince(begin_ns);
}

}  // namespace

void benchDepths(SurfaceBench& bench) {
  BenchSurface surface{"depth:table"};
  const std::int64_t begin_ns = monotonicNow_ns();
  const std::shared_ptr<const PrimitiveSource> table = makeDepthTable();
  surface.open_s = secondsSince(begin_ns);
  const auto& frame = dynamic_cast<const DepthFrame&>(*table);
  surface.stored = static_cast<double>(frame.image().grid->size().samples());
  surface.bytes = static_cast<double>(frame.image().bytes());
  surface.change_ms = nextFrame_ms(frame);
  const std::shared_ptr<const Snapshot> scene = makeSnapshot(alone("depth", table));
  for (const double radius_m : kRadii_m) bench.measure(surface, *scene, radius_m);
}

}  // namespace hl
