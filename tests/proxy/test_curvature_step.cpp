// Where surfaces are round, the proxy gets to the place in closed form in a few steps, whatever the curvature there.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/scenes.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_curvature_step {
namespace {

constexpr double kRadius = 1e-3;
constexpr double kExact = 1e-8 * kRadius;
const ProxySettings kSettings{kRadius, 1000};

// A post on a floor: the centre of the proxy moves on a circle about the post, a radius above the floor.
Model post() {
  Model model;
  model.positions = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1.5, 0), Vec3(0, 0, -1), Vec3(0, 0, 1)};
  model.triangles = {{0, 1, 2}};
  model.segments = {{3, 4}};
  return model;
}

// The finger is in the post's cylinder: `off` radii from its axis, which is how strongly it draws the proxy round.
TEST(CurvatureStep, RoundAPostOnAFloorItTakesFewSteps) {
  const auto snapshot = judge::scene(post());
  for (const double off : {0.02, 0.1, 0.5, 0.9}) {
    for (const double angle : {0.1, 0.5, 1.2}) {
      ProxyState state = startProxy(*snapshot, kSettings, Vec3(2, 0, 2) * kRadius);
      tick(state, *snapshot, kSettings, Vec3(0.5, 0, -2) * kRadius);
      const Vec3 round(std::cos(angle), std::sin(angle), 0);
      const TickReport report = tick(state, *snapshot, kSettings, (off * round - 2 * Vec3::UnitZ()) * kRadius);
      EXPECT_LE(report.iterations, 6) << off << ' ' << angle;
      EXPECT_LT((state.position - (round + Vec3::UnitZ()) * kRadius).norm(), kExact) << off << ' ' << angle;
    }
  }
}

// Two faces that meet in a ridge along y, each falling by `slope`.
Model ridge(double slope) {
  const Vec3 front(0, -0.1, 0), back(0, 0.1, 0);
  return judge::triangles({{front, back, Vec3(-0.1, 0, -0.1 * slope)}, {front, back, Vec3(0.1, 0, -0.1 * slope)}});
}

// A finger all but straight below a ridge lets the proxy roll off it: the farther off, the faster.
TEST(CurvatureStep, OffARidgeItGoesInStrides) {
  for (const double slope : {0.02, 0.2, 1.0}) {
    for (const double depth : {1.5e-3, 4e-3, 20e-3}) {
      const auto snapshot = judge::scene(ridge(slope));
      ProxyState state = startProxy(*snapshot, kSettings, Vec3(0, 0, 2e-3));
      tick(state, *snapshot, kSettings, Vec3(0, 0, 1e-4));
      const Vec3 finger(1e-9, 0, -depth);
      const TickReport report = tick(state, *snapshot, kSettings, finger);
      EXPECT_LE(report.iterations, 20) << slope << ' ' << depth;  // plain steps take up to 30
      const Vec3 normal = Vec3(slope, 0, 1).normalized();
      const Vec3 on_face = finger + (kRadius - normal.dot(finger)) * normal;
      EXPECT_LT((state.position - on_face).norm(), kExact) << slope << ' ' << depth;
    }
  }
}

// What a finger near a single point, the end of a wire or a wire itself asks of one tick, wherever the proxy was
// before: about a sphere, at the end of a cylinder, and about a cylinder. No plane gives how far round the proxy must
// go.
TEST(CurvatureStep, RoundAPointAndAWireItTakesFewSteps) {
  test::Random random(1109);
  Model point, wire;
  point.positions = {Vec3::Zero()};
  point.points = {0};
  wire.positions = {Vec3::Zero(), Vec3(0.1, 0, 0)};
  wire.segments = {{0, 1}};
  for (const Model& model : {point, wire}) {
    const auto snapshot = judge::scene(model);
    for (int i = 0; i < 2000; ++i) {
      ProxyState state = startProxy(*snapshot, kSettings, Vec3(random.direction() * 2 * kRadius));
      const double depth = kRadius * std::pow(10, random.uniform(-9, 1));
      tick(state, *snapshot, kSettings, -0.5 * state.position);
      const Vec3 finger = depth * random.direction();
      const TickReport report = tick(state, *snapshot, kSettings, finger);
      EXPECT_LE(report.iterations, 16) << i << ": " << depth;
      EXPECT_FALSE(report.capped());
      EXPECT_LT(judge::kktResidual(*snapshot, state.position, finger, kRadius), 1e-6) << i << ": " << depth;
    }
  }
}

// The proxy hangs between two wires that lean, or slips through.
TEST(CurvatureStep, BetweenWiresItSettles) {
  for (const double apart : {0.1e-3, 0.5e-3, 0.9e-3}) {
    Model wires;
    wires.positions = {Vec3(-apart, -0.1, 0), Vec3(-apart, 0.1, 0), Vec3(apart, -0.1, -0.03), Vec3(apart, 0.1, 0.03)};
    wires.segments = {{0, 1}, {2, 3}};
    const auto snapshot = judge::scene(wires);
    ProxyState state = startProxy(*snapshot, kSettings, Vec3(-apart, 0, 2e-3));
    for (int i = 1; i <= 50; ++i) {
      const Vec3 finger(1e-5 * i, 2e-5 * i, -10e-3);
      const TickReport report = tick(state, *snapshot, kSettings, finger);
      EXPECT_LE(report.iterations, 30) << apart << ' ' << i;
      EXPECT_LE(judge::kktResidual(*snapshot, state.position, finger, kRadius), 1e-6) << apart << ' ' << i;
      EXPECT_GE(judge::clearance(*snapshot, state.position, kRadius), kRadius * (1 - 1e-6)) << apart << ' ' << i;
    }
  }
}

// Hills of large triangles, and a finger some ten-thousandths of a radius from an edge or beyond it: the proxy, which
// comes from anywhere, is drawn round the edge by next to nothing, and other triangles are in its way.
TEST(CurvatureStep, AllButAtAnEdgeOfHillsItTakesFewSteps) {
  constexpr double kLarge = 0.01;
  const Model hills = judge::grid(13, 13, [](double u, double v) {
    const double x = 0.4 * u - 0.2, y = 0.4 * v - 0.2;
    return Vec3(x, y, 0.03 * std::sin(17 * x) * std::cos(13 * y) + 0.004 * std::sin(90 * x + 40 * y));
  });
  const auto snapshot = judge::scene(hills);
  test::Random random(71);
  int ticks = 0, steps = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto& t = hills.triangles[static_cast<std::size_t>(random.below(static_cast<int>(hills.triangles.size())))];
    const Vec3 a = hills.positions[t[0]], b = hills.positions[t[1]];
    const Vec3 finger =
        a + random.uniform(0, 1) * (b - a) + random.uniform(0.5, 3) * 1e-4 * kLarge * random.direction();
    if (finger.head<2>().norm() > 0.15) continue;
    const Vec3 above = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 2).normalized();
    ProxySettings settings{kLarge};
    settings.work_cap = 10'000;  // the proxy comes from far away: to the end, in one tick
    ProxyState state = startProxy(*snapshot, settings, finger + 3 * kLarge * above);
    if (!state.free) continue;
    const TickReport report = tick(state, *snapshot, settings, finger);
    ASSERT_FALSE(report.capped()) << i;
    ASSERT_LE(judge::kktResidual(*snapshot, state.position, finger, kLarge), 1e-6) << i;
    ASSERT_GE(judge::clearance(*snapshot, state.position, kLarge), kLarge * (1 - 1e-6)) << i;
    ++ticks;
    steps += report.iterations;
  }
  EXPECT_GT(ticks, 1000);
  EXPECT_LE(steps, 10 * ticks);  // 190 where each step must pay off at once and grows no bolder
}

}  // namespace
}  // namespace hl::test_curvature_step
