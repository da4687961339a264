// A box in single precision, for hierarchies.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "base/vec.h"

namespace hl {

/// Four lanes each, the last one unused, so a box is two registers.
struct FloatBox {
  Eigen::Array4f min = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array4f max = Eigen::Array4f::Constant(-std::numeric_limits<float>::infinity());

  void extend(const FloatBox& other) {
    min = min.min(other.min);
    max = max.max(other.max);
  }
  float halfArea() const {
    const Eigen::Array4f size = max - min;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

/// Rounds the bounds outward: by a relative 2^-22, four times the rounding error of single precision, and by the
/// smallest normal float. This bound is used instead of the actual rounding error because GCC 12 replaces a double that
/// was narrowed and widened again by the original double. Each operation is monotonic, so the box of several primitives
/// is exactly the union of their boxes.
inline FloatBox roundedOutward(const Vec3& low, const Vec3& high) {
  constexpr float kOutward = 1.0f / (1 << 22);
  FloatBox box;
  box.min.head<3>() = low.cast<float>().array();
  box.max.head<3>() = high.cast<float>().array();
  box.min -= kOutward * box.min.abs() + std::numeric_limits<float>::min();
  box.max += kOutward * box.max.abs() + std::numeric_limits<float>::min();
  return box;
}

}  // namespace hl
