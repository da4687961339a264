// Body poses: where a rigid body is. From one step of the bodies to the next it is on a screw.
#pragma once

#include <atomic>

#include "scene/motion.h"

namespace hl {

/// A body after a step. World frame.
struct ShownBody {
  Pose pose;                         ///< of its object frame
  Vec3 velocity_m_s = Vec3::Zero();  ///< of the centre of mass
  Vec3 spin_rad_s = Vec3::Zero();
};

/// What one thread writes and any number of others read. Neither waits for a lock; a reader reads again where it has
/// changed meanwhile (a sequence lock).
class SharedBody {
 public:
  explicit SharedBody(const ShownBody& body) { write(body); }
  /// One thread at a time. RT-safe.
  void write(const ShownBody& body) {
    writes_.fetch_add(1, std::memory_order_acq_rel);  // odd: it is being written
    for (int i = 0; i < 9; ++i) numbers_[i].store(body.pose.rotation(i), std::memory_order_relaxed);
    for (int i = 0; i < 3; ++i) {
      numbers_[9 + i].store(body.pose.origin(i), std::memory_order_relaxed);
      numbers_[12 + i].store(body.velocity_m_s(i), std::memory_order_relaxed);
      numbers_[15 + i].store(body.spin_rad_s(i), std::memory_order_relaxed);
    }
    writes_.fetch_add(1, std::memory_order_acq_rel);
  }
  /// Any thread.
  ShownBody read() const {
    for (;;) {
      const std::uint64_t before = writes_.load(std::memory_order_acquire);
      ShownBody body;
      for (int i = 0; i < 9; ++i) body.pose.rotation(i) = numbers_[i].load(std::memory_order_relaxed);
      for (int i = 0; i < 3; ++i) {
        body.pose.origin(i) = numbers_[9 + i].load(std::memory_order_relaxed);
        body.velocity_m_s(i) = numbers_[12 + i].load(std::memory_order_relaxed);
        body.spin_rad_s(i) = numbers_[15 + i].load(std::memory_order_relaxed);
      }
      // Adding nothing keeps the reads above before it, as no load could.
      if (before % 2 == 0 && writes_.fetch_add(0, std::memory_order_acq_rel) == before) return body;
    }
  }

 private:
  std::atomic<double> numbers_[18]{};
  mutable std::atomic<std::uint64_t> writes_{0};
};

/// Written by the loop that steps the bodies, between ticks. That loop alone uses it as a PoseSource; shown() is for
/// everybody else.
class BodyPoses final : public PoseSource {
 public:
  /// `object`: its bounds in its own frame. `room`: the body never leaves it, world frame.
  BodyPoses(const Pose& begin, const Box& object, const Box& room)
      : object_(object), room_(room), motion_(begin), near_(boxAt(object, begin)), shown_({begin}) {}

  /// From the present pose to that of `body` between the two moments, `begin_ns` < `end_ns`. RT-safe.
  void moveTo(const ShownBody& body, std::int64_t begin_ns, std::int64_t end_ns) {
    motion_ = Motion(Screw(motion_.to()), Screw(motion_.to(), body.pose, begin_ns, end_ns));
    near_ = motion_.reach(object_);
    shown_.write(body);
  }
  /// At once. RT-safe.
  void jumpTo(const ShownBody& body) {
    motion_ = Motion(body.pose);
    near_ = boxAt(object_, body.pose);
    shown_.write(body);
  }
  void jumpTo(const Pose& pose) { jumpTo(ShownBody{pose}); }
  /// Where it is from the begin to the end of the last step.
  const Box& near() const { return near_; }
  const Box& room() const { return room_; }
  const Box& object() const { return object_; }
  /// The end of the last step. Any thread.
  ShownBody shown() const { return shown_.read(); }

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
  SharedBody shown_;
};

}  // namespace hl
