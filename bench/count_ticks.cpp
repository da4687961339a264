// A fixed number of ticks along a fixed way, whose instructions scripts/counts counts.
//
//   count_ticks SURFACE TRIANGLES      SURFACE: free (in the air), plain, everything (with all effects of surfaces)
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "builtin.h"
#include "proxy/proxy.h"

// Highway measures its timer while it is loaded, for what nobody calls here, by an instruction (RDTSCP) that Valgrind
// does not know where the machine does not claim to have it. This stands in the place of that measurement.
namespace hwy::platform {
[[gnu::visibility("default")]] std::uint64_t TimerResolution() { return 1; }  // NOLINT(readability-identifier-naming)
}  // namespace hwy::platform

namespace hl {
namespace {

constexpr int kTicks = 1000;
constexpr double kWay = 0.15e-3;    // m per tick: 0.15 m/s at 1 kHz
constexpr double kDepth = 0.004;    // m, of the finger beneath the surface
constexpr double kHeight = 0.0005;  // m above the terrain's box: free, yet so near that the hierarchy is asked

// The newest set that every x86-64 machine has which can run HL at a useful speed; callgrind itself knows no AVX-512.
void useOneInstructionSet() {
  hwy::SetSupportedTargetsForTest(HWY_SSE4);
  hwy::GetChosenTarget().Update(HWY_SSE4);
}

void addEverything(Model& model) {
  model.textures = {makeTexture("noise", 64), makeTexture("checker", 64), makeTexture("sine", 64)};
  Material& material = model.materials[0];
  material.smooth = true;
  material.static_friction = 0.5;
  material.dynamic_friction = 0.3;
  material.viscosity_Ns_m = 2;
  material.textureOf(Quantity::kStiffness) = {0, 0.5, 1};
  material.textureOf(Quantity::kStaticFriction) = {1, 0.3, 0.6};
  material.textureOf(Quantity::kHeight) = {2, 0, 1e-4};
}

// Along a curve over the middle of the terrain; in contact kDepth beneath the proxy.
int run(const std::string& surface, const std::string& triangles) {
  Model model = makeBuiltinScene("terrain:" + triangles);
  if (surface == "everything") addEverything(model);
  const auto snapshot = makeSnapshot(std::move(model));
  const Vec3 centre = snapshot->bounds.centre(), size = snapshot->bounds.size();
  const double above = 0.5 * size.y() + kHeight, reach = 0.35 * std::min(size.x(), size.z());
  const ProxySettings settings;
  ManyRecentPrimitives recent;
  ProxyState state = startProxy(*snapshot, settings, centre + above * Vec3::UnitY());
  for (int i = 0; i < kTicks; ++i) {
    const double s = kWay * i / reach;
    Vec3 finger = centre + reach * Vec3(std::sin(s), 0, std::sin(1.618 * s) * std::cos(0.3 * s));
    finger.y() = surface == "free" ? centre.y() + above : std::min(finger.y(), state.position.y() - kDepth);
    tick(state, {*snapshot, 0, recent}, settings, finger);
    if (state.touching && surface == "free") {
      std::fprintf(stderr, "count_ticks: error: the way in the air touches the terrain\n");
      return 1;
    }
  }
  std::printf("%d ticks\n", kTicks);
  return 0;
}

}  // namespace
}  // namespace hl

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "count_ticks: error: use count_ticks SURFACE TRIANGLES\n");
    return 2;
  }
  hl::useOneInstructionSet();
  return hl::run(argv[1], argv[2]);
}
