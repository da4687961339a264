// Body poses: where a rigid body is. From one step of the bodies to the next it is on a screw.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/shared_numbers.h"
#include "scene/motion.h"

namespace hl {

/// A body after a step. World frame.
struct ShownBody {
  Pose pose;                         ///< of its object frame
  Vec3 velocity_m_s = Vec3::Zero();  ///< of the centre of mass
  Vec3 spin_rad_s = Vec3::Zero();
};

class SharedBody {
 public:
  explicit SharedBody(const ShownBody& body) { write(body); }
  /// One thread at a time. RT-safe.
  void write(const ShownBody& body) {
    std::array<double, 18> numbers;
    std::copy_n(body.pose.rotation.data(), 9, numbers.begin());
    std::copy_n(body.pose.origin.data(), 3, numbers.begin() + 9);
    std::copy_n(body.velocity_m_s.data(), 3, numbers.begin() + 12);
    std::copy_n(body.spin_rad_s.data(), 3, numbers.begin() + 15);
    numbers_.write(numbers);
  }
  /// Any thread.
  ShownBody read() const {
    const std::array<double, 18> numbers = numbers_.read();
    ShownBody body;
    std::copy_n(numbers.begin(), 9, body.pose.rotation.data());
    std::copy_n(numbers.begin() + 9, 3, body.pose.origin.data());
    std::copy_n(numbers.begin() + 12, 3, body.velocity_m_s.data());
    std::copy_n(numbers.begin() + 15, 3, body.spin_rad_s.data());
    return body;
  }

 private:
  SharedNumbers<18> numbers_;
};

/// How a body that no joint holds answers impulses.
struct BodyMobility {
  double inverse_mass = 0;                ///< 1/kg
  Mat3 inverse_inertia_O = Mat3::Zero();  ///< 1/(kg m^2), about the centre of mass, in the object frame
  Vec3 centre_O = Vec3::Zero();           ///< m, the centre of mass
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
  void setMobility(const BodyMobility& mobility) { mobility_ = mobility; }
  /// 1/kg: the largest velocity across `normal` that an impulse of 1 N s across it gives the body at `point`. World
  /// frame, at the end of the last step; 0 before the first.
  double mobilityAcross(const Vec3& point, const Vec3& normal) const;
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
  BodyMobility mobility_{};
  SharedBody shown_;
};

// The larger eigenvalue of J M^-1 J^T in the plane across the normal.
inline double BodyPoses::mobilityAcross(const Vec3& point, const Vec3& normal) const {
  const Pose pose = motion_.to();
  const Vec3 arm_O = pose.toObject(point) - mobility_.centre_O, normal_O = pose.rotation.transpose() * normal;
  const Vec3 s = normal_O.unitOrthogonal(), t = normal_O.cross(s);
  const auto response = [&](const Vec3& impulse) {
    return Vec3(mobility_.inverse_mass * impulse + (mobility_.inverse_inertia_O * arm_O.cross(impulse)).cross(arm_O));
  };
  const double ss = s.dot(response(s)), st = s.dot(response(t)), tt = t.dot(response(t));
  return (ss + tt) / 2 + std::hypot((ss - tt) / 2, st);
}

}  // namespace hl
