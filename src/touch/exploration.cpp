#include "touch/exploration.h"

#include <cmath>

#include "scene/scene_at.h"

namespace hl {

namespace {

constexpr double kAzimuthRate = 0.45;    // rad/s: about 30 mm/s on a model fitted to the device
constexpr double kElevationRate = 0.31;  // rad/s; no small ratio to the azimuth, so that the path wanders everywhere
constexpr double kStroke_s = 7.0;
constexpr double kLifted = 0.15;  // part of a stroke spent in the air

Vec3 direction(double time_s) {
  const double azimuth = kAzimuthRate * time_s;
  const double elevation = 0.5 + 0.6 * std::sin(kElevationRate * time_s);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

// 1 while pressing, 0 in the air, smooth between.
double pressing(double time_s) {
  const double phase = time_s / kStroke_s - std::floor(time_s / kStroke_s);
  const double edge = std::min(phase, 1 - phase) / (0.5 * kLifted);
  const double s = std::min(1.0, edge);
  return s * s * (3 - 2 * s);
}

}  // namespace

Vec3 explore(const SceneAt& scene, const ExplorationSettings& settings, double time_s) {
  const Snapshot& snapshot = scene.snapshot();
  const Vec3 centre = snapshot.bounds.centre();
  const double reach = 0.5 * snapshot.bounds.size().norm() + 4 * settings.radius + settings.lift;
  const Vec3 outward = direction(time_s);
  const Vec3 from = centre + reach * outward;
  SceneImpact impact;
  const bool hit = scene.firstImpact(from, -reach * outward, settings.radius, -1, impact);
  const double surface = hit ? reach * (1 - impact.impact.t) : 0.0;
  const double depth = settings.press * pressing(time_s) - settings.lift * (1 - pressing(time_s));
  return centre + (surface - depth) * outward;
}

}  // namespace hl
