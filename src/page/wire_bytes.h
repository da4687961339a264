// WireBytes: numbers as the page reads them: float32 and uint32, little-endian, one after the other.
#pragma once

#include <bit>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/motion.h"

namespace hl {

static_assert(std::endian::native == std::endian::little, "the page is sent the machine's own bytes");

inline void appendFloat(std::string& bytes, double value) {
  const float narrow = static_cast<float>(value);
  bytes.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
}

/// Three numbers for each.
inline std::string floatsOf(const std::vector<Vec3>& points) {
  std::string bytes;
  bytes.reserve(3 * sizeof(float) * points.size());
  for (const Vec3& p : points) {
    for (int i = 0; i < 3; ++i) appendFloat(bytes, p[i]);
  }
  return bytes;
}

/// Of integers, or arrays of them.
template <typename T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// [rotation | origin], row by row.
inline void appendPose(std::string& bytes, const Pose& pose) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) appendFloat(bytes, pose.rotation(row, column));
    appendFloat(bytes, pose.origin[row]);
  }
}

}  // namespace hl
