// Workspace: how the hand's space maps to the scene's. A model of any unit is fitted to the device by one uniform
// scale; forces are made from distances at the hand, so the stiffness felt is the device's, whatever the scale.
#pragma once

#include <algorithm>

#include "base/vec.h"
#include "geometry/primitive.h"
#include "scene/model.h"

namespace hl {

/// p_W = origin_W + world_per_device * p_D, axes parallel.
struct Workspace {
  Vec3 origin_W = Vec3::Zero();
  double world_per_device = 1;  ///< metres of the scene for one metre of the hand

  Vec3 toWorld(const Vec3& p_D) const { return origin_W + world_per_device * p_D; }
  Vec3 toDevice(const Vec3& p_W) const { return (p_W - origin_W) / world_per_device; }

  /// Whether lengths at the hand and in the world both stay numbers that can be computed with.
  bool valid() const {
    constexpr double kMaxScale = 1e9;
    return withinReach(origin_W) && world_per_device <= kMaxScale && world_per_device >= 1 / kMaxScale;
  }
  /// The same of a proxy's radius, m.
  static bool validRadius(double radius_W) { return radius_W >= 1e-12 && radius_W <= kFarthest_m; }

  /// Centres `bounds` at the device's origin with its largest side `side_D` metres long at the hand.
  static Workspace fit(const Box& bounds, double side_D) {
    if (bounds.empty()) return {};
    const double side_W = bounds.size().maxCoeff();
    return {bounds.centre(), side_W > 0 ? side_W / side_D : 1.0};
  }
};

}  // namespace hl
