// Pose: where an object is, and how it is turned.
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

/// Holds all of an object's box when the object is at `pose`; the object's own box when they share a frame.
Box boxAt(const Box& object, const Pose& pose);

}  // namespace hl
