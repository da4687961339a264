// Goal: what the steps of a tick go toward. That is the finger; or, where force shading runs once a tick, the place
// where its two passes want the proxy, until the proxy is there or has left the surface.
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
  void aimAtFinger() { place_ = finger_; }

  /// Whether a is nearer to the goal than b, |goal - a| < |goal - b|, however far the goal is: by what lies between a
  /// and b.
  bool nearer(const Vec3& a, const Vec3& b) const {
    const Vec3 apart = a - b;
    return 2 * apart.dot(place_ - b) > apart.squaredNorm();
  }

 private:
  Vec3 finger_, place_;
};

}  // namespace hl
