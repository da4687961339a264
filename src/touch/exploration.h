// Exploration: the built-in hand that strokes the model, so that something is felt on a machine without a person.
// It circles the model slowly, presses a little beneath the surface that a sphere falling inward would meet, and lifts
// now and then.
#pragma once

#include "base/vec.h"
#include "scene/scene_at.h"

namespace hl {

struct ExplorationSettings {
  double press = 0.010;   ///< m (world) beneath the surface that the hand aims for
  double lift = 0.012;    ///< m (world) above it between strokes
  double radius = 0.002;  ///< m (world) of the sphere that finds the surface
};

/// Where the hand wants to be `time_s` after the start, world frame; the scene is not empty. Deterministic; any thread,
/// never a real-time one.
Vec3 explore(const SceneAt& scene, const ExplorationSettings& settings, double time_s);

}  // namespace hl
