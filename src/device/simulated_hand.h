// SimulatedHand: the hand that holds a device when no person does.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "base/vec.h"

namespace hl {

/// One thread, any; lock-free.
class SimulatedHand {
 public:
  virtual ~SimulatedHand() = default;
  /// Where the hand wants to be, in D; ignored unless finite.
  virtual void setHandGoal(const Vec3& goal_D) = 0;
  virtual void setHandFirm(bool firm) = 0;
  /// false: it lets go; true: it takes hold of the device where that is.
  virtual void setHandHolds(bool holds) = 0;
  /// The buttons it presses, bit i: button i.
  virtual void setHandButtons(std::uint32_t buttons) = 0;
  /// How it wants the stylus to be turned, in D; ignored unless it is an orientation, or where there is no wrist.
  virtual void setHandTurn(const Eigen::Quaterniond& goal_D) = 0;
  /// How far it wants the gripper to be open, rad; ignored unless finite, or where there is none.
  virtual void setHandGripper(double goal_rad) = 0;
};

}  // namespace hl
