// Pose: position and orientation of an object.
#pragma once

#include "base/vec.h"
#include "geometry/box.h"

namespace hl {

/// A rigid placement: p_W = rotation * p_O + origin.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 origin = Vec3::Zero();

  Vec3 toWorld(const Vec3& p_O) const { return rotation * p_O + origin; }
  Vec3 toObject(const Vec3& p_W) const { return rotation.transpose() * (p_W - origin); }
  Vec3 turnToWorld(const Vec3& v_O) const { return rotation * v_O; }
  Vec3 turnToObject(const Vec3& v_W) const { return rotation.transpose() * v_W; }
  bool operator==(const Pose& other) const { return rotation == other.rotation && origin == other.origin; }
};

/// A box that contains the object's box at `pose`; the box itself if `pose` is the identity.
Box boxAt(const Box& object, const Pose& pose);

}  // namespace hl
