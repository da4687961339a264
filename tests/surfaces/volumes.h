// Volumes for tests, and the same triangles as a mesh.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/scenes.h"
#include "index_judge.h"
#include "surfaces/iso_surface.h"

namespace hl::test {

using Side = std::array<std::uint32_t, 3>;

/// Float samples value(x, y, z), in samples.
inline std::shared_ptr<const Volume> volumeOf(const Side& side, const std::function<double(const Vec3& at)>& value) {
  const auto samples = std::make_shared<std::vector<float>>();
  for (std::uint32_t z = 0; z < side[2]; ++z) {
    for (std::uint32_t y = 0; y < side[1]; ++y) {
      for (std::uint32_t x = 0; x < side[0]; ++x) samples->push_back(static_cast<float>(value(Vec3(x, y, z))));
    }
  }
  const std::shared_ptr<const void> data(samples, samples->data());
  return std::make_shared<const Volume>(VoxelGrid(side, Samples(SampleKind::kFloat32, data)));
}

/// Cubic cells of `spacing` (m), the first sample at `origin` (m).
inline GridFrame cubicFrame(double spacing, const Vec3& origin = Vec3::Zero()) {
  return {spacing * Mat3::Identity(), origin};
}

/// A surface of random form: waves and noise, kind of samples, gaps, side of the matter, frame, samples on the surface.
inline std::shared_ptr<const IsoSurface> randomSurface(Random& random) {
  Side side{};
  for (std::uint32_t& one : side) one = static_cast<std::uint32_t>(2 + random.below(random.below(3) == 0 ? 3 : 20));
  const double noise = std::pow(10.0, random.uniform(-2, 1)), gaps = random.below(4) == 0 ? 0.03 : 0;
  const Vec3 slope = random.inCube(0.5), waves = random.inCube(2);
  const auto value = [&](const Vec3& at) {
    const Vec3 phase = 0.5 * at;
    return slope.dot(at) + waves.x() * std::sin(phase.x()) + waves.y() * std::cos(phase.y() + phase.z()) +
           noise * random.uniform(-1, 1);
  };
  GridFrame frame = cubicFrame(1);
  const int form = random.below(4);
  if (form == 1) frame.axes.col(0) *= random.uniform(0.3, 3);
  if (form == 2) frame.axes = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
  if (form == 3) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) frame.axes.col(axis) += random.inCube(0.4);
  }
  if (random.below(2) == 0) frame.axes.col(1) *= -1;
  const double scale = std::pow(10.0, random.below(3) == 0 ? random.uniform(-7, 5) : -3);
  frame = frame.placed(scale * Mat3::Identity(), random.below(2) * scale * random.inCube(1e3));
  const IsoValue iso{0, random.below(2) == 0 ? SolidSide::kAbove : SolidSide::kBelow};
  const bool whole = random.below(2) == 0;  // numbers: many samples lie on the surface
  const auto volume = volumeOf(side, [&](const Vec3& at) {
    if (random.uniform(0, 1) < gaps) return static_cast<double>(NAN);
    return whole ? std::round(value(at)) : value(at);
  });
  return std::make_shared<const IsoSurface>(volume, frame, iso);
}

}  // namespace hl::test
