// Clouds for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/scenes.h"
#include "surfaces/cloud_maker.h"
#include "surfaces/point_cloud.h"

namespace hl::test {

inline std::shared_ptr<const CloudPoints> cloudOf(const std::vector<Vec3>& positions,
                                                  const std::vector<std::uint32_t>& normals = {}) {
  std::size_t skipped = 0;
  return makeCloud(onFineLattice(positions, normals, skipped));
}

/// n x n points in the plane y = 0, around the origin.
inline std::vector<Vec3> squareGrid(int n, double spacing) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) points.emplace_back(spacing * (i - n / 2), 0, spacing * (j - n / 2));
  }
  return points;
}

/// A cloud of random form: in a cube, on a wavy sheet, on a line, at few places, with far points; in a random frame.
inline std::shared_ptr<const PointCloud> randomCloud(Random& random) {
  const int form = random.below(5);
  std::vector<Vec3> points(static_cast<std::size_t>(1 + random.below(random.below(3) == 0 ? 20 : 300)));
  for (Vec3& p : points) {
    p = random.inCube(1);
    if (form == 1) p.y() = 0.1 * std::sin(5 * p.x()) * std::cos(4 * p.z());
    if (form == 2) p.y() = p.z() = 0.3 * p.x();
    if (form == 3) p = (3 * p).array().round();
    if (form == 4 && random.below(30) == 0) p *= 1e5;
  }
  GridFrame frame;
  frame.axes = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
  if (random.below(3) == 0) frame.axes.col(0) *= random.uniform(0.2, 5);
  if (random.below(3) == 0) frame.axes.col(1) += random.inCube(0.4);
  const double scale = std::pow(10.0, random.below(3) == 0 ? random.uniform(-6, 3) : -3);
  CloudLook look;
  look.form = random.below(2) == 0 ? CloudForm::kPoints : CloudForm::kSurfels;
  look.reach = random.uniform(0.3, 2);
  const PointCloud cloud(cloudOf(points), look);
  const auto placed = cloud.placed(scale * frame.axes, random.below(2) * scale * random.inCube(100));
  return std::dynamic_pointer_cast<const PointCloud>(placed);
}

}  // namespace hl::test
