// What the benchmark of bodies measures: overlaps and energy of cubes, and the finger that pushes one.
#include <gtest/gtest.h>

#include <cmath>

#include "cubes/body_engine.h"

namespace hl::bench::test_cubes {
namespace {

CubeState cubeAt(const Vec3& centre, double turn_rad = 0) {
  CubeState cube;
  cube.centre = centre;
  cube.turned = Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()).toRotationMatrix();
  return cube;
}

TEST(Cubes, OverlapsAreThoseOfTheLeastWayOut) {
  const CubeScene open;
  EXPECT_NEAR(deepestOverlap_m(open, {cubeAt({0, 0.02, 0}), cubeAt({0, 0.059, 0})}), 0.001, 1e-12);
  EXPECT_EQ(deepestOverlap_m(open, {cubeAt({0, 0.0201, 0}), cubeAt({0, 0.0602, 0})}), 0);
  const double diagonal_m = std::sqrt(2) * 0.02;
  EXPECT_NEAR(deepestOverlap_m(open, {cubeAt({0, diagonal_m - 0.002, 0}, M_PI / 4)}), 0.002, 1e-12);
  EXPECT_NEAR(deepestOverlap_m(open, {cubeAt({0, 0.1, 0}), cubeAt({0.02 + diagonal_m - 0.003, 0.1, 0}, M_PI / 4)}),
              0.003, 1e-12);
  CubeScene box;
  box.walls_m = 0.13;
  EXPECT_NEAR(deepestOverlap_m(box, {cubeAt({0, 0.1, -0.1105})}), 0.0005, 1e-12);
}

TEST(Cubes, EnergyIsThatOfMotionTurnAndHeight) {
  CubeState cube = cubeAt({0, 1, 0});
  cube.velocity = {0, 0, 2};
  cube.spin = {3, 0, 0};
  EXPECT_NEAR(energyOf_J({cube}), 0.1 * 9.81 + 0.2 + 0.1 * 0.04 * 0.04 / 6 * 9 / 2, 1e-15);
}

TEST(Cubes, TheFingerFeelsTheFriction) {
  const CubeScene scene = cubeScenes().back();
  const auto engine = makeOwnBodies(scene);
  double finger_m = -kCubeHalf_m, force_N = 0;
  for (int i = 0; i < scene.steps; ++i) force_N = engine->step(finger_m += kBodyStep_s * scene.finger_m_s);
  EXPECT_NEAR(force_N, 0.3924, 1e-5);
  EXPECT_NEAR(engine->cube(0).centre.x(), finger_m + kCubeHalf_m - 0.0003924, 1e-7);
}

}  // namespace
}  // namespace hl::bench::test_cubes
