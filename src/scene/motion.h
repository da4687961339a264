// Motion: the pose of an object over time. Between two frames of its client it moves on a screw: it turns at a constant
// rate about one axis and slides along it. So an object hinged to a fixed point stays hinged.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "scene/pose_source.h"

namespace hl {

/// A screw motion between two poses. Immutable; any thread.
class Screw {
 public:
  /// `begin_ns` < `end_ns`. A turn of more than half a circle takes the shorter direction.
  Screw(const Pose& from, const Pose& to, std::int64_t begin_ns, std::int64_t end_ns);
  explicit Screw(const Pose& rest) : from_(rest), to_(rest) {}

  bool moves() const { return moves_; }
  const Pose& from() const { return from_; }
  const Pose& to() const { return to_; }
  std::int64_t begin_ns() const { return begin_ns_; }
  std::int64_t end_ns() const { return end_ns_; }
  double angle() const { return turn_.norm(); }  ///< rad
  /// The same bits for the same time; exactly from() before the begin and to() after the end. RT-safe.
  Pose at(std::int64_t time_ns) const;

 private:
  Pose from_, to_;
  std::int64_t begin_ns_ = 0, end_ns_ = 0;
  bool moves_ = false;
  Vec3 turn_ = Vec3::Zero();   // rad, rotation vector of to * from^-1
  Vec3 slide_ = Vec3::Zero();  // m, v of the twist (turn, v) with exp(turn, v) = to * from^-1
};

/// At rest, or on one or two successive screws without a jump. Immutable; any thread.
class Motion final : public PoseSource {
 public:
  /// Permanently at rest.
  explicit Motion(const Pose& pose = {}) : earlier_(pose), last_(pose), identity_(pose == Pose{}) {}
  /// From two screws, as returned by earlier() and last().
  Motion(const Screw& earlier, const Screw& last)
      : earlier_(earlier), last_(last), identity_(!moves() && last.to() == Pose{}) {}
  /// This motion until `begin_ns`, and then a screw from the pose at that time to `to` at `end_ns` > `begin_ns`.
  Motion then(const Pose& to, std::int64_t begin_ns, std::int64_t end_ns) const;

  bool moves() const override { return earlier_.moves() || last_.moves(); }
  bool identity() const { return identity_; }  ///< at rest, and object frame and world are one
  const Screw& earlier() const { return earlier_; }
  const Screw& last() const { return last_; }
  Pose to() const override { return last_.to(); }
  Pose at(std::int64_t time_ns) const override {
    return time_ns < last_.begin_ns() ? earlier_.at(time_ns) : last_.at(time_ns);
  }
  std::int64_t straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const override;
  std::int64_t restsFrom_ns() const override { return last_.end_ns(); }
  Box reach(const Box& object) const override;

 private:
  Screw earlier_, last_;
  bool identity_ = false;
};

}  // namespace hl
