// GridFrame: where a grid lies: an affine map from grid coordinates to metres in the frame of the object. So oblique
// and scaled grids need no resampling.
#pragma once

#include "base/vec.h"

namespace hl {

/// Of a length between samples, m, or of a factor on samples, that somebody gives.
inline constexpr double kMinGridStep = 1e-12, kMaxGridStep = 1e9;

/// p = origin + axes (column, row, value). The columns of `axes` are in m per grid step and m per unit of the samples.
struct GridFrame {
  Mat3 axes = Mat3::Identity();
  Vec3 origin = Vec3::Zero();

  /// The same bits for the same arguments, wherever it is called from: cells that share a vertex agree on it. RT-safe.
  Vec3 point(double column, double row, double value) const {
    const double across[3] = {column, row, value};
    Vec3 p = origin;
    for (Eigen::Index axis = 0; axis < 3; ++axis) p += across[axis] * axes.col(axis);
    return p;
  }
  /// The frame moved by x -> linear x + offset.
  GridFrame placed(const Mat3& linear, const Vec3& offset) const { return {linear * axes, linear * origin + offset}; }
};

}  // namespace hl
