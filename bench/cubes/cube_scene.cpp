#include "cubes/cube_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hl::bench {

namespace {

// Half of the cube's extent along a unit direction.
double halfAlong(const CubeState& cube, const Vec3& direction) {
  return kCubeHalf_m * (cube.turned.transpose() * direction).cwiseAbs().sum();
}

// By the separating axes: of two boxes one of fifteen gives how far they are apart.
double overlapOf(const CubeState& a, const CubeState& b) {
  const Vec3 between = b.centre - a.centre;
  if (between.norm() > 2 * std::sqrt(3.0) * kCubeHalf_m) return 0;
  double least = 2 * kCubeHalf_m;
  const auto look = [&](const Vec3& axis) {
    const double length = axis.norm();
    if (length < 1e-6) return;
    const Vec3 unit = axis / length;
    least = std::min(least, halfAlong(a, unit) + halfAlong(b, unit) - std::abs(unit.dot(between)));
  };
  for (int i = 0; i < 3; ++i) {
    look(a.turned.col(i));
    look(b.turned.col(i));
    for (int j = 0; j < 3; ++j) look(a.turned.col(i).cross(b.turned.col(j)));
  }
  return std::max(0.0, least);
}

CubeScene stack() {
  CubeScene scene;
  scene.name = "stack of 10";
  for (int i = 0; i < 10; ++i) scene.cubes.push_back({Mat3::Identity(), Vec3(0, (2 * i + 1) * kCubeHalf_m, 0)});
  return scene;
}

CubeScene pile() {
  CubeScene scene;
  scene.name = "pile of 100";
  scene.walls_m = 0.13;
  for (int i = 0; i < 100; ++i) {
    const Vec3 at(0.075 * (i % 3 - 1), 0.04 + 0.075 * (i / 9), 0.075 * (i / 3 % 3 - 1));
    scene.cubes.push_back({Eigen::AngleAxisd(0.3 * i, Vec3(1, 2, 3).normalized()).toRotationMatrix(), at});
  }
  return scene;
}

CubeScene pushed() {
  CubeScene scene;
  scene.name = "pushed";
  scene.friction = 0.4;
  scene.finger_m_s = 0.01;
  scene.cubes.push_back({Mat3::Identity(), Vec3(0, kCubeHalf_m, 0)});
  return scene;
}

}  // namespace

std::vector<CubeScene> cubeScenes() { return {stack(), pile(), pushed()}; }

double energyOf_J(const std::vector<CubeState>& cubes) {
  const double inertia = kCube_kg * 2.0 / 3 * kCubeHalf_m * kCubeHalf_m;
  double sum = 0;
  for (const CubeState& cube : cubes) {
    sum += kCube_kg * (cube.velocity.squaredNorm() / 2 + kEarth_m_s2 * cube.centre.y()) +
           inertia * cube.spin.squaredNorm() / 2;
  }
  return sum;
}

double deepestOverlap_m(const CubeScene& scene, const std::vector<CubeState>& cubes) {
  double deepest = 0;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const CubeState& cube = cubes[i];
    deepest = std::max(deepest, halfAlong(cube, Vec3::UnitY()) - cube.centre.y());
    for (const int axis : {0, 2}) {
      if (!(scene.walls_m > 0)) continue;
      const double far_m = std::abs(cube.centre[axis]) + halfAlong(cube, Vec3::Unit(axis));
      deepest = std::max(deepest, far_m - scene.walls_m);
    }
    for (std::size_t j = 0; j < i; ++j) deepest = std::max(deepest, overlapOf(cube, cubes[j]));
  }
  return deepest;
}

}  // namespace hl::bench
