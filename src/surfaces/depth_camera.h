// Depth camera: how the pixels of a depth image lie in space, and which of them belong together.
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace hl {

/// A pinhole camera without distortion, in pixels: the pixel in column u and row v looks along
/// ((u - cx) / fx, (v - cy) / fy, 1), x to the right, y down, z away from the camera; depths are along z.
struct DepthCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double join = 0.02;  ///< > 0: neighbours are one surface where their depths differ by at most this part of the nearer

  double across(double column) const { return (column - cx) / fx; }
  double down(double row) const { return (row - cy) / fy; }
  /// Whether three depths, none below 0, are one surface; not, if one is 0. RT-safe.
  bool joins(float a, float b, float c) const {
    const float least = std::min({a, b, c}), most = std::max({a, b, c});
    return least > 0 && most - least <= static_cast<float>(join) * least;
  }
  bool operator==(const DepthCamera&) const = default;
};

/// Throws hl::Error for what is no camera.
void checkCamera(const DepthCamera& camera);

}  // namespace hl
