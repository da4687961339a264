// Cube scene: what every engine gets: equal cubes on a floor, in a box or not, and perhaps a finger that pushes one.
#pragma once

#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/pose.h"

namespace hl::bench {

inline constexpr double kCubeHalf_m = 0.02, kCube_kg = 0.1, kBodyStep_s = 1e-3, kEarth_m_s2 = 9.81;

/// The floor is y = 0.
struct CubeScene {
  std::string name;
  std::vector<Pose> cubes;  ///< at the begin, at rest
  double friction = 0.5;
  double walls_m = 0;     ///< four walls so far from the middle; 0: none
  double finger_m_s = 0;  ///< > 0: a finger pushes the first cube along x, at its centre's height
  int steps = 3000;
};

struct CubeState {
  Vec3 centre = Vec3::Zero();
  Mat3 turned = Mat3::Identity();
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();  ///< world frame
};

/// A stack of ten, a pile of a hundred that falls into a box, and one that is pushed.
std::vector<CubeScene> cubeScenes();

/// J; kinetic energy and that of gravity.
double energyOf_J(const std::vector<CubeState>& cubes);
/// m; how far two cubes, or a cube and the floor or a wall, are one in the other at most.
double deepestOverlap_m(const CubeScene& scene, const std::vector<CubeState>& cubes);

}  // namespace hl::bench
