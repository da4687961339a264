// Body poses: where a rigid body is. From one step of the bodies to the next it is on a screw.
#pragma once

#include <atomic>

#include "scene/motion.h"

namespace hl {

/// A pose that one thread writes and any number of others read. Neither waits for a lock; a reader reads again where
/// the pose has changed meanwhile (a sequence lock).
class SharedPose {
 public:
  explicit SharedPose(const Pose& pose) { write(pose); }
  /// One thread at a time. RT-safe.
  void write(const Pose& pose) {
    writes_.fetch_add(1, std::memory_order_acq_rel);  // odd: it is being written
    for (int i = 0; i < 9; ++i) numbers_[i].store(pose.rotation(i), std::memory_order_relaxed);
    for (int i = 0; i < 3; ++i) numbers_[9 + i].store(pose.origin(i), std::memory_order_relaxed);
    writes_.fetch_add(1, std::memory_order_acq_rel);
  }
  /// Any thread.
  Pose read() const {
    for (;;) {
      const std::uint64_t before = writes_.load(std::memory_order_acquire);
      Pose pose;
      for (int i = 0; i < 9; ++i) pose.rotation(i) = numbers_[i].load(std::memory_order_relaxed);
      for (int i = 0; i < 3; ++i) pose.origin(i) = numbers_[9 + i].load(std::memory_order_relaxed);
      // Adding nothing keeps the reads above before it, as no load could.
      if (before % 2 == 0 && writes_.fetch_add(0, std::memory_order_acq_rel) == before) return pose;
    }
  }

 private:
  std::atomic<double> numbers_[12]{};
  mutable std::atomic<std::uint64_t> writes_{0};
};

/// Written by the loop that steps the bodies, between ticks. That loop alone uses it as a PoseSource; shown() is for
/// everybody else.
class BodyPoses final : public PoseSource {
 public:
  /// `object`: its bounds in its own frame. `room`: the body never leaves it, world frame.
  BodyPoses(const Pose& begin, const Box& object, const Box& room)
      : object_(object), room_(room), motion_(begin), near_(boxAt(object, begin)), shown_(begin) {}

  /// From the present pose to `pose` between the two moments, `begin_ns` < `end_ns`. RT-safe.
  void moveTo(const Pose& pose, std::int64_t begin_ns, std::int64_t end_ns) {
    motion_ = Motion(Screw(motion_.to()), Screw(motion_.to(), pose, begin_ns, end_ns));
    near_ = motion_.reach(object_);
    shown_.write(pose);
  }
  /// At once. RT-safe.
  void jumpTo(const Pose& pose) {
    motion_ = Motion(pose);
    near_ = boxAt(object_, pose);
    shown_.write(pose);
  }
  /// Where it is from the begin to the end of the last step.
  const Box& near() const { return near_; }
  const Box& room() const { return room_; }
  const Box& object() const { return object_; }
  /// The end of the last step. Any thread.
  Pose shown() const { return shown_.read(); }

  Pose at(std::int64_t time_ns) const override { return motion_.at(time_ns); }
  std::int64_t straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const override {
    return motion_.straightUntil(now_ns, until_ns, turn_rad);
  }
  bool moves() const override { return true; }
  std::int64_t restsFrom_ns() const override { return kNever_ns; }
  Pose to() const override { return motion_.to(); }
  /// Any thread.
  Box reach(const Box&) const override { return room_; }

 private:
  const Box object_, room_;
  Motion motion_;
  Box near_;
  SharedPose shown_;
};

}  // namespace hl
