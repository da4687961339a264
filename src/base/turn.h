// Turns: orientations as unit quaternions.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "base/plain_math.h"
#include "base/vec.h"

namespace hl {

/// Makes it one of unit length. False, and nothing is changed, if it is no orientation: zero, or not finite.
inline bool toUnit(Eigen::Quaterniond& turned) {
  const double largest = turned.coeffs().cwiseAbs().maxCoeff();
  if (!turned.coeffs().allFinite() || !(largest > 0)) return false;
  turned.coeffs() /= largest;  // its square may be no number
  turned.normalize();
  return true;
}

/// Axis times angle, the short way round: 0..pi rad. Of a unit quaternion; the same bits with every C library.
inline Vec3 rotationVector(const Eigen::Quaterniond& turned) {
  const double sine = turned.vec().norm();  // of half the angle
  if (!(sine > 0)) return Vec3::Zero();
  const double angle = 2 * plain::angleOf(std::abs(turned.w()), sine);
  return (turned.w() < 0 ? -angle : angle) / sine * turned.vec();
}

}  // namespace hl
