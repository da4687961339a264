// Goal: the point toward which the steps of a tick go. It is the finger. If force shading runs once per tick, it is the
// result of its two passes, until the proxy has reached it or has left the surface.
#pragma once

#include "base/vec.h"

namespace hl {

/// World frame. RT-safe.
class Goal {
 public:
  explicit Goal(const Vec3& finger) : finger_(finger), place_(finger) {}

  const Vec3& place() const { return place_; }
  bool isFinger() const { return place_ == finger_; }
  void aimAt(const Vec3& place) { place_ = place; }

  /// Whether a is nearer to the goal than b, |goal - a| < |goal - b|. Computed from the difference of a and b, so that
  /// it is accurate however far the goal is.
  bool nearer(const Vec3& a, const Vec3& b) const {
    const Vec3 apart = a - b;
    return 2 * apart.dot(place_ - b) > apart.squaredNorm();
  }

 private:
  Vec3 finger_, place_;
};

}  // namespace hl
