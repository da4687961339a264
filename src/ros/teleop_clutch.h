// TeleopClutch: where a hand wants the robot to be. The robot follows the hand's way, not its place: while the clutch
// is open it stays, and the hand goes back to where it has room.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "ros/teleop_settings.h"

namespace hl {

/// Of one hand, by one thread.
class TeleopClutch {
 public:
  explicit TeleopClutch(const TeleopSettings& settings) : settings_(settings) {}

  /// The hand is at `place_D`. It leads while the servo makes force and the button is not down; with a button only
  /// after that has been down and let go once, so that nobody leads a robot unaware.
  void follow(const Vec3& place_D, std::uint64_t buttons, bool makes_force);
  bool engaged() const { return engaged_; }
  /// From where the robot was at first; m at the robot.
  const Vec3& setPoint() const { return set_point_; }

 private:
  const TeleopSettings settings_;
  Vec3 set_point_ = Vec3::Zero();
  Vec3 zero_ = Vec3::Zero();  // the set-point of a hand at 0 0 0, while engaged
  bool pressed_once_ = false, engaged_ = false;
};

}  // namespace hl
