// Depth frames for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "fields.h"
#include "surfaces/depth_frame.h"

namespace hl::test {

inline std::shared_ptr<const DepthFrame> frameOf(const std::shared_ptr<const HeightGrid>& grid,
                                                 const DepthCamera& camera, double scale_m = 1) {
  return std::make_shared<const DepthFrame>(smoothed(*grid, 1, camera, nullptr, 0), cameraFrame(scale_m));
}

inline DepthCamera cameraFor(std::uint32_t columns, std::uint32_t rows) {
  return {0.9 * columns, 0.9 * columns, 0.5 * columns, 0.5 * rows};
}

/// A depth image of random form: slopes and waves, steps in depth, holes, any placement.
inline std::shared_ptr<const DepthFrame> randomFrame(Random& random) {
  const auto columns = static_cast<std::uint32_t>(2 + random.below(random.below(3) == 0 ? 3 : 60));
  const auto rows = static_cast<std::uint32_t>(2 + random.below(random.below(3) == 0 ? 3 : 60));
  DepthCamera camera = cameraFor(columns, rows);
  camera.fx *= std::pow(10.0, random.uniform(-0.5, 1));
  camera.cx += random.uniform(-1, 1) * columns;
  camera.join = std::pow(10.0, random.uniform(-2.5, -0.5));
  const double rough = std::pow(10.0, random.uniform(-4, -1)), waves = random.uniform(0, 0.05);
  const double slope = random.uniform(-0.02, 0.02), gaps = random.below(3) == 0 ? 0.1 : 0;
  std::vector<float> depths;
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double step = (i / 8 + j / 8) % 2 == 0 ? 0 : 0.3;
      const double depth = 1 + step + slope * i + waves * std::sin(0.3 * i + 0.2 * j) + rough * random.uniform(-1, 1);
      depths.push_back(random.uniform(0, 1) < gaps ? 0 : static_cast<float>(std::max(0.05, depth)));
    }
  }
  GridFrame frame = cameraFrame(std::pow(10.0, random.uniform(-2, 1)));
  if (random.below(2) == 0)
    frame =
        frame.placed(Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix(), random.inCube(3));
  if (random.below(3) == 0) frame = frame.placed(Mat3::Identity() + 0.3 * Mat3::Random(), Vec3::Zero());
  return std::make_shared<const DepthFrame>(smoothed(*gridOf(columns, rows, depths), 1, camera, nullptr, 0), frame);
}

}  // namespace hl::test
