// What slides over a flat mesh does not feel its seams.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies/test_worlds.h"
#include "draws.h"

namespace hl::test_seams {
namespace {

using test::Playground;

constexpr double kGravity_m_s2 = 9.81;

// A floor at y = 0 of 2 m, of squares of two triangles.
std::shared_ptr<const Snapshot> floorOfSquares(double square_m) {
  Model model;
  const int count = static_cast<int>(std::round(2 / square_m));
  for (int i = 0; i <= count; ++i) {
    for (int j = 0; j <= count; ++j) model.positions.emplace_back(i * square_m - 1, 0, j * square_m - 1);
  }
  const auto corner = [&](int i, int j) { return static_cast<std::uint32_t>(i * (count + 1) + j); };
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      model.triangles.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j)});
      model.triangles.push_back({corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)});
    }
  }
  return makeSnapshot(std::move(model));
}

// m/s after so many steps, of a cube that began with `speed_m_s`.
double speedAfter(int steps, test::Draws& draws, double half_m, double speed_m_s, double friction, double square_m) {
  World world;
  world.fixed = floorOfSquares(square_m);
  world.bodies = {test::block(1, 0.1, Vec3::Constant(half_m), friction)};
  const Mat3 turned = Eigen::AngleAxisd(draws.between(0, 3), Vec3::UnitY()).toRotationMatrix();
  Playground play(std::move(world), {{turned, Vec3(draws.between(-0.02, 0.02), half_m, draws.between(-0.02, 0.02))}});
  const double way = draws.between(0, 2 * M_PI);
  play.state.bodies[0].velocity = speed_m_s * Vec3(std::cos(way), 0, std::sin(way));
  play.steps(steps);
  return play.state.bodies[0].velocity.norm();
}

// Up to 35 % of its size a step.
TEST(Seams, DoNotStopWhatSlidesOverThem) {
  test::Draws draws(1);
  for (int run = 0; run < 60; ++run) {
    const double half_m = draws.between(0.004, 0.03), square_m = run % 2 == 0 ? 0.04 : 0.02;
    const double friction = draws.between(0, 0.8), speed_m_s = std::pow(10, draws.between(-1, 0.5));
    const double stops_s = friction > 0 ? speed_m_s / (friction * kGravity_m_s2) : 1;
    const double time_s = std::min({stops_s / 2, 0.1, 0.5 / speed_m_s});
    const int steps = static_cast<int>(1e3 * time_s);
    const double expected = speed_m_s - friction * kGravity_m_s2 * 1e-3 * steps;
    // In the first step nothing bears yet.
    EXPECT_NEAR(speedAfter(steps, draws, half_m, speed_m_s, friction, square_m), expected, 0.02 * speed_m_s + 2e-2)
        << "half " << half_m << " m, " << speed_m_s << " m/s, friction " << friction << ", squares " << square_m;
  }
}

}  // namespace
}  // namespace hl::test_seams
