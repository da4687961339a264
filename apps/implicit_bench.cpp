#include <memory>
#include <string>

#include "base/clock.h"
#include "sdf.h"
#include "surface_bench.h"
#include "surfaces/implicit/implicit_surface.h"

namespace hl {

namespace {

constexpr double kErrors_m[] = {1e-5, 1e-6}, kSolidRadii_m[] = {1e-3, 3e-3};

}  // namespace

void benchImplicits(SurfaceBench& bench) {
  for (const std::string name : {"sdf:torus", "sdf:gyroid", "sdf:blend", "sdf:bracket"}) {
    for (const double error_m : kErrors_m) {
      const SceneModel model = makeSdf(name);
      const auto& source = dynamic_cast<const ImplicitSurface&>(*model.surfaces.front().source);
      ImplicitSpec spec = source.spec();
      spec.error_m = error_m;
      const std::int64_t begin_ns = monotonicNow_ns();
      const std::shared_ptr<const Snapshot> scene =
          makeSnapshot(alone(name, std::make_shared<const ImplicitSurface>(spec)));
      BenchSurface surface{name + (error_m < 1e-5 ? " within 1 um" : " within 10 um"), 0, 0, secondsSince(begin_ns)};
      surface.bytes = static_cast<double>(scene->shape().geometryBytes());
      for (const double radius_m : kSolidRadii_m) bench.measure(surface, *scene, radius_m);
    }
  }
}

}  // namespace hl
