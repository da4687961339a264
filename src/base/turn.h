// Turns: orientations as unit quaternions.
#pragma once

#include <Eigen/Geometry>

namespace hl {

/// Makes it one of unit length. False, and nothing is changed, if it is no orientation: zero, or not finite.
inline bool toUnit(Eigen::Quaterniond& turned) {
  const double largest = turned.coeffs().cwiseAbs().maxCoeff();
  if (!turned.coeffs().allFinite() || !(largest > 0)) return false;
  turned.coeffs() /= largest;  // its square may be no number
  turned.normalize();
  return true;
}

}  // namespace hl
