// Tick input: constant data that all stages of one tick share.
#pragma once

#include "base/vec.h"
#include "proxy/far_goal.h"
#include "proxy/proxy_state.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// World frame. The scene and the settings must outlive this object.
struct TickInput {
  TickInput(const SceneAt& scene_now, const ProxySettings& rules, const Vec3& finger_now)
      : TickInput(scene_now, rules, finger_now, scene_now.extent()) {}

  /// Vector from `position` to the finger, shortened to the length at which steps may aim (far_goal.h).
  Vec3 gap(const Vec3& position) const { return far.shortened(finger - position); }
  /// Whether `step` is below the rest threshold at `position` (accuracy::kRestPerGap).
  bool stationary(const Vec3& step, const Vec3& position) const {
    return step.norm() <= accuracy::kRestPerGap * far.shortened_m(finger - position) + tolerance.rest;
  }

  const SceneAt& scene;
  const ProxySettings& settings;
  const Vec3 finger;
  const Tolerances tolerance;
  const double longest_m;  ///< longest sweep
  const FarGoal far;

 private:
  TickInput(const SceneAt& scene_now, const ProxySettings& rules, const Vec3& finger_now, double extent)
      : scene(scene_now),
        settings(rules),
        finger(finger_now),
        tolerance(Tolerances::of(rules.radius, extent)),
        longest_m(accuracy::kSweepPerExtent * (extent + tolerance.reach)),
        far(longest_m) {}
};

}  // namespace hl
