#include "bodies/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "bodies/hull_faces.h"

namespace hl {

namespace {

constexpr double kFlat = 1e-6;  // thickness over size

// Throws for points that lie in a plane.
void demandThick(std::span<const Vec3> points, double size) {
  if (points.size() < 4 || !(thinnestSlab(points, size).thickness > kFlat * size))
    throw Error("hull: the points lie in a plane: give the shape a thickness, or use a box");
}

}  // namespace

Slab thinnestSlab(std::span<const Vec3> points, double size) {
  if (!(size > 0)) return {};
  Mat3 second = Mat3::Zero();
  for (const Vec3& point : points) {
    const Vec3 way = (point - points[0]) / size;
    second += way * way.transpose() / static_cast<double>(points.size());
  }
  const Vec3 thin = Eigen::SelfAdjointEigenSolver<Mat3>(second).eigenvectors().col(0);
  double least = 0, most = 0;  // of the first point
  for (const Vec3& point : points) {
    least = std::min(least, thin.dot(point - points[0]));
    most = std::max(most, thin.dot(point - points[0]));
  }
  return {thin, most - least};
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
  demandThick(points, unit.size);
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
  shape.thin *= size;
  hull.shape = moved(std::move(shape), middle);
  return hull;
}

}  // namespace hl
