// Normal between the corners of a triangle, as shading by vertex normals has it.
#pragma once

#include <array>
#include <cstddef>

#include "base/vec.h"

namespace hl {

/// At a corner its normal_at(number), to the bit; elsewhere the unit vector along their sum with barycentric weights; 0
/// where that sum is 0. RT-safe.
template <typename NormalAt>
Vec3 normalBetween(const std::array<Vec3, 3>& corner, const Vec3& point, const NormalAt& normal_at) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (corner[i] == point) return normal_at(i);
  }
  const Vec3 edge1 = corner[1] - corner[0], edge2 = corner[2] - corner[0], area = edge1.cross(edge2);
  const Vec3 from = point - corner[0];
  const double weight1 = from.cross(edge2).dot(area) / area.squaredNorm();
  const double weight2 = edge1.cross(from).dot(area) / area.squaredNorm();
  const Vec3 sum = (1 - weight1 - weight2) * normal_at(0) + weight1 * normal_at(1) + weight2 * normal_at(2);
  return sum.normalized();
}

}  // namespace hl
