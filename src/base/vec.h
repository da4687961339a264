// The linear algebra of HL is Eigen's; these are the names used everywhere. All geometry is in double.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hl {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;  ///< metres unless the name says otherwise; world frame unless the name says otherwise
using Mat3 = Eigen::Matrix3d;

/// v, shortened to `length` where it is longer. RT-safe.
inline Vec3 limited(const Vec3& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vec3(v * (length / norm)) : v;
}

}  // namespace hl
