// Stylus: the part of a device that the hand holds: how it is turned, and how far its gripper is open.
#pragma once

#include <Eigen/Geometry>

#include "base/turn.h"
#include "base/vec.h"

namespace hl {

/// In the device frame D. Of a device without a wrist it is never turned, and one without a gripper is closed.
struct Stylus {
  /// Unit; from the axes of the stylus to those of D. Not turned, a pen points away from the user: its shaft lies along
  /// +z, to the user's hand.
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  Vec3 spin_rad_s = Vec3::Zero();  ///< its angular velocity
  double gripper_rad = 0;          ///< how far the gripper is open
  double gripper_N = 0;            ///< with which the hand closes it; 0: the device does not report it
};

inline bool operator==(const Stylus& a, const Stylus& b) {
  return a.turned.coeffs() == b.turned.coeffs() && a.spin_rad_s == b.spin_rad_s && a.gripper_rad == b.gripper_rad &&
         a.gripper_N == b.gripper_N;
}

}  // namespace hl
