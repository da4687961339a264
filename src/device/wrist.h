// Wrist: the simulated gimbal of a stylus, with a gripper, in a hand that turns it. No motor acts on it.
// The hand turns it as a critically damped spring, as people reach for a place: without overshoot. Encoders count the
// three angles of the gimbal.
#pragma once

#include "device/stylus.h"

namespace hl {

struct WristParameters {
  double resolution_rad = 0;          ///< of each angle; 0: the device has no wrist
  double gripper_max_rad = 0;         ///< 0: it has no gripper
  double gripper_resolution_rad = 0;  ///< of its angle
};

/// One thread; RT-safe.
class Wrist {
 public:
  explicit Wrist(const WristParameters& parameters);

  /// Where the hand wants it; ignored unless it is an orientation. Without a wrist: nothing turns.
  void turnTo(const Eigen::Quaterniond& goal_D);
  /// How far the hand wants its gripper to be open, rad; clamped to what there is, ignored unless finite.
  void openTo(double goal_rad);
  /// Time passes, of any length.
  void step(double dt_s);
  /// What the encoders count. The spin is left to who reads it.
  Stylus counted() const;
  /// Where it is.
  const Eigen::Quaterniond& turned() const { return turned_; }

  /// How a hand holds a pen at rest, where there is a wrist: its upper end toward the user and 35 degrees up.
  static Eigen::Quaterniond atRest();

 private:
  void stepOnce(double dt_s);

  WristParameters parameters_;
  Eigen::Quaterniond goal_, turned_;
  Vec3 spin_rad_s_ = Vec3::Zero();
  double gripper_goal_rad_ = 0, gripper_rad_ = 0, gripper_rad_s_ = 0;
};

}  // namespace hl
