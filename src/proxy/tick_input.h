// Tick input: what the stages of one tick share and none of them changes.
#pragma once

#include "base/vec.h"
#include "proxy/far_goal.h"
#include "proxy/proxy_state.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// World frame. The scene and the settings must outlive it.
struct TickInput {
  TickInput(const SceneAt& scene_now, const ProxySettings& rules, const Vec3& finger_now)
      : TickInput(scene_now, rules, finger_now, scene_now.extent()) {}

  /// The way from the proxy to the finger, as far as steps aim.
  Vec3 gap(const Vec3& position) const { return far.shortened(finger - position); }
  /// Whether a step is so short that the proxy is stationary: accuracy::kRestPerGap.
  bool stationary(const Vec3& step, const Vec3& position) const {
    return step.norm() <= accuracy::kRestPerGap * far.shortened_m(finger - position) + tolerance.rest;
  }

  const SceneAt& scene;
  const ProxySettings& settings;
  const Vec3 finger;
  const Tolerances tolerance;
  const double longest_m;  ///< of one sweep
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
