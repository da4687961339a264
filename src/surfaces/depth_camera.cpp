#include "surfaces/depth_camera.h"

#include <cmath>

#include "base/error.h"

namespace hl {

void checkCamera(const DepthCamera& camera) {
  const auto fits = [](double focal) { return focal >= 1e-3 && focal <= 1e9; };
  if (!fits(camera.fx) || !fits(camera.fy) || !(std::abs(camera.cx) <= 1e9) || !(std::abs(camera.cy) <= 1e9))
    throw Error("a depth camera needs four numbers: focal lengths fx and fy above 0, and its centre cx, cy, in pixels");
  if (!(camera.join > 0 && camera.join <= 1)) throw Error("join must be above 0, and at most 1");
}

}  // namespace hl
