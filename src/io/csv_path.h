// A finger path: CSV with the header t,x,y,z, and perhaps qw,qx,qy,qz for the stylus and gripper_rad; seconds, metres
// and radians in the world frame.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"

namespace hl {

/// Shorter steps of time are none to the arithmetic of viscosity, longer times have none left.
inline constexpr double kMinStep_s = 1e-15, kLastTime_s = 1e15;

struct PathSample {
  double t = 0;  ///< s, strictly increasing, by 1e-15 at least
  Vec3 position = Vec3::Zero();
  // In all rows of a path or in none.
  std::optional<Eigen::Quaterniond> turned{};  ///< of the stylus; unit
  std::optional<double> gripper_rad{};         ///< how far its gripper is open
};

/// Throws hl::Error that names the file and line for anything that is not such a path. At least one row.
std::vector<PathSample> readPath(const std::string& file);

}  // namespace hl
