#include "phantom.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/huge_pages.h"
#include "surfaces/iso_surface.h"

namespace hl {

namespace {

constexpr double kSide_mm = 160, kAir_HU = -1000, kTissue_HU = 40, kBone_HU = 700;

// Distances from surfaces, mm: negative inside.
double fromBall(const Vec3& p, const Vec3& centre, double radius) { return (p - centre).norm() - radius; }

double fromRod(const Vec3& p, const Vec3& middle, const Vec3& axis, double half_length, double radius) {
  const Vec3 away = p - middle;
  const double along = std::clamp(away.dot(axis), -half_length, half_length);
  return (away - along * axis).norm() - radius;
}

double fromPlate(const Vec3& p, const Vec3& middle, const Vec3& normal, double half_thickness, double radius) {
  const Vec3 away = p - middle;
  const double across = std::abs(away.dot(normal)) - half_thickness;
  return std::max(across, away.norm() - radius);
}

const Vec3 kCut = Vec3(std::sin(M_PI / 9), std::cos(M_PI / 9), 0);

double fromTissue(const Vec3& p) {
  const double ball = std::max(fromBall(p, Vec3(0, 10, 0), 60), kCut.dot(p - Vec3(0, 48, 0)));
  return std::min(ball, fromRod(p, Vec3(0, -60, 0), Vec3(0, 1, 0), 30, 28));
}

double fromBone(const Vec3& p) {
  const double ball = fromBall(p, Vec3(-22, 18, 12), 14);
  const double rod = fromRod(p, Vec3(0, -40, 0), Vec3(0, 1, 0), 40, 9);
  const double plate = fromPlate(p, Vec3(24, 12, 8), Vec3(1, 1, 2).normalized(), 3, 22);
  return std::min({ball, rod, plate});
}

// 0 outside, 1 inside, over two samples.
double partInside(double distance_mm, double spacing_mm) {
  return std::clamp(0.5 - distance_mm / (2 * spacing_mm), 0.0, 1.0);
}

std::shared_ptr<const Volume> scanOf(std::uint32_t side) {
  const double spacing_mm = kSide_mm / (side - 1);
  auto samples = std::make_shared<HugeVector<std::int16_t>>(std::size_t{side} * side * side);
  using Range = oneapi::tbb::blocked_range<std::uint32_t>;
  oneapi::tbb::parallel_for(Range(0, side), [&](const Range& slices) {
    for (std::uint32_t z = slices.begin(); z < slices.end(); ++z) {
      for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
          const Vec3 p = spacing_mm * Vec3(x, y, z) - Vec3::Constant(kSide_mm / 2);
          const double value = kAir_HU + (kTissue_HU - kAir_HU) * partInside(fromTissue(p), spacing_mm) +
                               (kBone_HU - kTissue_HU) * partInside(fromBone(p), spacing_mm);
          (*samples)[(std::size_t{z} * side + y) * side + x] = static_cast<std::int16_t>(std::lround(value));
        }
      }
    }
  });
  const std::int16_t* const first = samples->data();
  return std::make_shared<const Volume>(VoxelGrid(
      {side, side, side}, Samples(SampleKind::kInt16, std::shared_ptr<const void>(std::move(samples), first))));
}

}  // namespace

SceneModel makePhantom(std::uint32_t side) {
  const std::shared_ptr<const Volume> scan = scanOf(side);
  GridFrame frame;
  frame.axes *= 1e-3 * kSide_mm / (side - 1);
  frame.origin = Vec3::Constant(-5e-4 * kSide_mm);
  SceneModel scene;
  scene.model.name = "ct:phantom";
  const auto add = [&](const char* name, double value, double stiffness) {
    Material material;
    material.stiffness = stiffness;
    scene.surfaces.push_back({name, std::make_shared<const IsoSurface>(scan, frame, IsoValue{value}), material});
  };
  add("skin", (kAir_HU + kTissue_HU) / 2, 0.5);
  add("bone", (kTissue_HU + kBone_HU) / 2, 1);
  return scene;
}

}  // namespace hl
