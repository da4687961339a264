#include "bodies/mass.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "bodies/mesh_holes.h"

namespace hl {

namespace {

using Triangles = std::span<const std::array<std::uint32_t, 3>>;

// Of the cube of its size: a mesh with less volume is a sheet.
constexpr double kNoVolume = 1e-9;

void demandPositive(double value, const char* what) {
  if (!(value > 0) || !std::isfinite(value)) throw Error(std::string("mass: ") + what + " must be above 0");
}

// Each edge must be passed once in each direction for each time it is there.
void demandClosed(std::span<const Vec3> vertices, Triangles triangles) {
  for (const auto& corners : triangles) {
    if (*std::max_element(corners.begin(), corners.end()) >= vertices.size())
      throw Error("mass: a triangle has a corner that is no vertex");
  }
  const auto open = openEdges(triangles);
  if (!open.empty())
    throw Error("mass: the mesh is open at " + std::to_string(open.size()) +
                " edges: close it, join its equal vertices, or use its hull or a box");
}

}  // namespace

Mass massOfBall(double mass_kg, double radius_m) {
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = 0.4 * mass_kg * radius_m * radius_m * Mat3::Identity();
  return mass;
}

Mass massOfBox(double mass_kg, const Vec3& half_m) {
  const Vec3 square = half_m.cwiseProduct(half_m);
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = (mass_kg / 3 * (Vec3::Constant(square.sum()) - square)).asDiagonal();
  return mass;
}

// The half balls: inertia 2/5 m r^2 about the flat face's centre, whose distance from their own centre is 3/8 r.
Mass massOfCapsule(double mass_kg, double half_length_m, double radius_m) {
  const double length = 2 * half_length_m, r = radius_m;
  const double cylinder_part = length / (length + 4.0 / 3 * r);  // of the volume
  const double cylinder = cylinder_part * mass_kg, balls = mass_kg - cylinder;
  const double along = cylinder * r * r / 2 + balls * 2.0 / 5 * r * r;
  const double across = cylinder * (length * length / 12 + r * r / 4) +
                        balls * (2.0 / 5 * r * r + length * length / 4 + 3.0 / 8 * length * r);
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = Vec3(across, across, along).asDiagonal();
  return mass;
}

Mass massOfCylinder(double mass_kg, double half_length_m, double radius_m) {
  const double square = radius_m * radius_m;
  const double across = mass_kg * (square / 4 + half_length_m * half_length_m / 3);
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = Vec3(across, across, mass_kg * square / 2).asDiagonal();
  return mass;
}

// Tetrahedra from the middle of the vertices to each triangle (p, q, r), with the sign of their volume
// V = p . (q x r) / 6. Their first moment is V (p + q + r) / 4, the second V (p p' + q q' + r r' + s s') / 20, s = p +
// q + r. Inertia is trace(second) 1 - second.
Solid solidOf(std::span<const Vec3> vertices, Triangles triangles) {
  demandClosed(vertices, triangles);
  Vec3 origin = Vec3::Zero(), low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& vertex : vertices) {
    origin += vertex / static_cast<double>(vertices.size());
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& corners : triangles) {
    const Vec3 p = vertices[corners[0]] - origin, q = vertices[corners[1]] - origin, r = vertices[corners[2]] - origin;
    const Vec3 sum = p + q + r;
    const double part = p.dot(q.cross(r)) / 6;
    volume += part;
    first += part / 4 * sum;
    second += part / 20 * (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
  }
  const double size = triangles.empty() ? 0 : (high - low).norm();
  if (!(std::abs(volume) > kNoVolume * size * size * size))
    throw Error("mass: the mesh holds no volume: give it a thickness, or use a box");
  const Vec3 centre = first / volume;
  if (volume < 0) second = -second;
  volume = std::abs(volume);
  second -= volume * centre * centre.transpose();
  return {volume, origin + centre, second.trace() * Mat3::Identity() - second};
}

// Each triangle is a prism of half the thickness on both of its sides, so its winding does not matter. Over a triangle
// the integral of x x^T is A / 12 (the sum over its corners p p^T, and s s^T, s the sum of the corners).
Solid solidOfSheet(std::span<const Vec3> vertices, Triangles triangles, double thickness_m) {
  demandPositive(thickness_m, "the thickness");
  const Vec3 origin = vertices.empty() ? Vec3(Vec3::Zero()) : vertices.front();
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& corners : triangles) {
    const Vec3 p = vertices[corners[0]] - origin, q = vertices[corners[1]] - origin, r = vertices[corners[2]] - origin;
    const Vec3 across = (q - p).cross(r - p), sum = p + q + r;
    if (across.isZero(0)) continue;
    const Vec3 normal = across.normalized();
    const double part = thickness_m * across.norm() / 2;
    volume += part;
    first += part / 3 * sum;
    second += part / 12 * (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
    second += part * thickness_m * thickness_m / 12 * normal * normal.transpose();
  }
  if (!(volume > 0)) throw Error("mass: the mesh has no area");
  const Vec3 centre = first / volume;
  second -= volume * centre * centre.transpose();
  return {volume, origin + centre, second.trace() * Mat3::Identity() - second};
}

Solid sumOf(std::span<const Solid> solids) {
  Solid sum{0, Vec3::Zero(), Mat3::Zero()};
  Vec3 first = Vec3::Zero();
  for (const Solid& solid : solids) {
    sum.volume_m3 += solid.volume_m3;
    first += solid.volume_m3 * solid.centre_O;
  }
  sum.centre_O = first / sum.volume_m3;
  for (const Solid& solid : solids) {
    const Vec3 way = solid.centre_O - sum.centre_O;
    sum.inertia_m5 += solid.inertia_m5;
    sum.inertia_m5 += solid.volume_m3 * (way.squaredNorm() * Mat3::Identity() - way * way.transpose());
  }
  return sum;
}

// With the second moments S = tr(I) / 2 - I: of any matter they are positive, and of mass between a and b whose centre
// is at c they are at most (b - c) (c - a), as if all of it were at both ends.
bool isMatterWithin(const Box& bounds, const Solid& solid) {
  if (!(solid.volume_m3 > 0) || !solid.inertia_m5.allFinite()) return false;
  const Vec3 beyond = bounds.max - solid.centre_O, before = solid.centre_O - bounds.min;
  if (!(beyond.minCoeff() > 0 && before.minCoeff() > 0)) return false;
  const Mat3 moments = 0.5 * solid.inertia_m5.trace() * Mat3::Identity() - solid.inertia_m5;
  const Vec3 most = solid.volume_m3 * beyond.cwiseProduct(before);
  if ((moments.diagonal().array() > most.array()).any()) return false;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(moments, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() > 0;
}

Mass massOfDensity(double density_kg_m3, const Solid& solid) {
  demandPositive(density_kg_m3, "the density");
  return {density_kg_m3 * solid.volume_m3, solid.centre_O, density_kg_m3 * solid.inertia_m5};
}

Solid solidOf(const Convex& polyhedron) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Convex::Face& face : polyhedron.faces) {
    for (std::size_t i = 2; i < face.corners.size(); ++i)
      triangles.push_back({face.corners[0], face.corners[i - 1], face.corners[i]});
  }
  return solidOf(polyhedron.vertices, triangles);
}

}  // namespace hl
