// Shared joint: what a joint does, published to other threads than the one that steps it.
#pragma once

#include "base/shared_numbers.h"
#include "base/vec.h"

namespace hl {

/// A joint after a step. Forces act on its body a.
struct ShownJoint {
  double coordinate = 0;       ///< m or rad
  double velocity = 0;         ///< m/s or rad/s
  double force = 0;            ///< N or N m, along the coordinate
  Vec3 held_N = Vec3::Zero();  ///< with which it holds a at its anchor, world frame
};

class SharedJoint {
 public:
  /// One thread at a time. RT-safe.
  void write(const ShownJoint& joint) {
    const Vec3& held = joint.held_N;
    numbers_.write({joint.coordinate, joint.velocity, joint.force, held.x(), held.y(), held.z()});
  }
  /// Any thread.
  ShownJoint read() const {
    const auto [coordinate, velocity, force, x, y, z] = numbers_.read();
    return {coordinate, velocity, force, Vec3(x, y, z)};
  }

 private:
  SharedNumbers<6> numbers_;
};

}  // namespace hl
