#include "bodies/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/plain_math.h"
#include "bodies/hull_faces.h"

namespace hl {

namespace {

constexpr double kFlat = 1e-6;  // thickness over size

// Throws for points that lie in a plane.
void demandThick(std::span<const Vec3> points, const Vec3& middle, double size) {
  const Vec3 thin = size > 0 ? thinnestWay(points, size) : Vec3::UnitX();
  double least = 1e300, most = -1e300;
  for (const Vec3& point : points) {
    least = std::min(least, thin.dot(point - middle));
    most = std::max(most, thin.dot(point - middle));
  }
  if (points.size() < 4 || !(most - least > kFlat * size))
    throw Error("hull: the points lie in a plane: give the shape a thickness, or use a box");
}

}  // namespace

Vec3 thinnestWay(std::span<const Vec3> points, double size) {
  Mat3 second = Mat3::Zero();
  for (const Vec3& point : points) {
    const Vec3 way = (point - points[0]) / size;
    second += way * way.transpose() / static_cast<double>(points.size());
  }
  return Eigen::SelfAdjointEigenSolver<Mat3>(second).eigenvectors().col(0);
}

UnitPoints unitPoints(std::span<const Vec3> points) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& point : points) {
    if (!point.allFinite()) throw Error("hull: a point is not finite");
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  UnitPoints unit;
  unit.middle = (low + high) / 2;
  unit.size = points.empty() ? 0 : (high - low).norm() / 2;
  demandThick(points, unit.middle, unit.size);
  for (const Vec3& point : points) unit.points.emplace_back((point - unit.middle) / unit.size);
  return unit;
}

Hull hullOf(std::span<const Vec3> points) {
  const auto [unit, middle, size] = unitPoints(points);
  const HullFaces faces = hullFaces(unit);
  Convex shape = polyhedronShape(pointsOf(unit, faces.points), faces.faces);
  Hull hull;
  hull.error_m = size * faces.error;
  for (Vec3& vertex : shape.vertices) vertex *= size;
  hull.shape = moved(std::move(shape), middle);
  return hull;
}

Convex coneShape(double half_length, double radius) {
  std::vector<Vec3> points{half_length * Vec3::UnitZ()};
  for (std::size_t i = 0; i < kCylinderSides; ++i) {
    const double angle = 2 * EIGEN_PI * static_cast<double>(i) / kCylinderSides;
    points.emplace_back(radius * plain::cos(angle), radius * plain::sin(angle), -half_length);
  }
  return hullOf(points).shape;
}

}  // namespace hl
