// Body engine: what moves the cubes of a scene: HL's own step, and other engines with their usual settings.
#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "cubes/cube_scene.h"

namespace hl::bench {

/// N/m, of the spring between a finger and the cube that it pushes.
inline constexpr double kPushSpring_N_m = 1000;

class BodyEngine {
 public:
  virtual ~BodyEngine() = default;
  /// kBodyStep_s of time; the finger is at `finger_m` along x at the begin. Returns the force on the cube, N, >= 0.
  virtual double step(double finger_m) = 0;
  virtual CubeState cube(std::size_t i) const = 0;
};

/// N: of a spring from a finger to the cube's face where it is now: how a hand's force comes into an engine from
/// outside.
inline double pushOf_N(double finger_m, const CubeState& cube) {
  return kPushSpring_N_m * std::max(0.0, finger_m - (cube.centre.x() - kCubeHalf_m));
}

struct BodyEngineKind {
  const char* name;
  std::unique_ptr<BodyEngine> (*make)(const CubeScene& scene);
  std::size_t most_cubes;  ///< it takes too long for more
};

std::unique_ptr<BodyEngine> makeOwnBodies(const CubeScene& scene);
/// Empty when HL was built without them (HL_BENCH_PEERS).
std::span<const BodyEngineKind> bodyPeers();

std::unique_ptr<BodyEngine> makeBulletBodies(const CubeScene& scene);
std::unique_ptr<BodyEngine> makeOdeBodies(const CubeScene& scene);
std::unique_ptr<BodyEngine> makeOdeExactBodies(const CubeScene& scene);
std::unique_ptr<BodyEngine> makeMujocoBodies(const CubeScene& scene);

}  // namespace hl::bench
