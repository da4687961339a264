// Motion: where an object is at each moment. Between two frames of its client it moves on a screw: turning at a
// constant rate about one axis and sliding along it, so that what is hinged to a fixed point stays hinged.
#pragma once

#include <cstdint>

#include "base/vec.h"

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

/// Rests at `from` until begin, moves, and rests at `to` from end on. Immutable; any thread.
class Motion {
 public:
  /// At rest for ever.
  explicit Motion(const Pose& pose = {});
  /// `begin_ns` < `end_ns`; a turn of more than half a circle goes the short way round.
  Motion(const Pose& from, const Pose& to, std::int64_t begin_ns, std::int64_t end_ns);

  bool moves() const { return moves_; }
  bool identity() const { return identity_; }  ///< at rest, and object frame and world are one
  const Pose& from() const { return from_; }
  const Pose& to() const { return to_; }
  std::int64_t end_ns() const { return end_ns_; }
  /// The same bits for the same moment; exactly from() and to() outside the motion. RT-safe.
  Pose at(std::int64_t time_ns) const;
  double angle() const { return turn_.norm(); }  ///< rad, of the whole motion

 private:
  Pose from_, to_;
  std::int64_t begin_ns_ = 0, end_ns_ = 0;
  bool moves_ = false, identity_ = false;
  Vec3 turn_ = Vec3::Zero();   // rad, rotation vector of to * from^-1
  Vec3 slide_ = Vec3::Zero();  // m, v of the twist (turn, v) with exp(turn, v) = to * from^-1
};

}  // namespace hl
