// Body poses: where a body is from one step to the next: on a screw. The driver of its instance in the snapshot.
#pragma once

#include "scene/motion.h"

namespace hl {

/// Written by the loop that steps the bodies, between ticks; read in the same thread.
class BodyPoses final : public PoseSource {
 public:
  /// `room`: the body never leaves it, world frame.
  BodyPoses(const Pose& begin, const Box& room) : motion_(begin), room_(room) {}

  /// From the present pose to `pose` between the two moments, `begin_ns` < `end_ns`. RT-safe.
  void moveTo(const Pose& pose, std::int64_t begin_ns, std::int64_t end_ns) {
    motion_ = Motion(Screw(motion_.to()), Screw(motion_.to(), pose, begin_ns, end_ns));
  }
  Pose at(std::int64_t time_ns) const override { return motion_.at(time_ns); }
  std::int64_t straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const override {
    return motion_.straightUntil(now_ns, until_ns, turn_rad);
  }
  bool moves() const override { return true; }
  std::int64_t restsFrom_ns() const override { return kNever_ns; }
  Pose to() const override { return motion_.to(); }
  Box reach(const Box& object) const override {
    Box reach = room_;
    const Box here = motion_.reach(object);
    reach.extend(here.min);
    reach.extend(here.max);
    return reach;
  }

 private:
  Motion motion_;
  Box room_;
};

}  // namespace hl
