// Sliding over fine meshes: no seam is felt, and the proxy is never left behind, where open libraries get stuck.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_proxy_slide {
namespace {

constexpr double kRadius = 1e-3;
constexpr double kPeriod_s = 1e-3;
const ProxySettings kSettings{kRadius, 1000};

struct SlideReport {
  double behind_m = 0;  // farthest distance from the local minimum, estimated by the residual times the gap
  double worst_residual = 0;
  double least_clearance = 1e9;
  int capped = 0, out_of_work = 0;
  int most_iterations = 0;
};

// Drags the finger along path(t), t in 0..1, over `length` metres at `speed`, and judges every tick.
template <typename Path>
SlideReport slide(const Snapshot& snapshot, Path path, double length, double speed, ProxyState& state) {
  SlideReport report;
  const int ticks = static_cast<int>(length / (speed * kPeriod_s));
  for (int i = 0; i <= ticks; ++i) {
    const Vec3 finger = path(double(i) / ticks);
    const TickReport t = tick(state, snapshot, kSettings, finger);
    report.capped += t.capped();
    report.most_iterations = std::max(report.most_iterations, t.iterations);
    const bool cut_short = t.ending == Ending::kOutOfWork;
    report.out_of_work += cut_short;
    if (!cut_short) {
      const double residual = judge::kktResidual(snapshot, state.position, finger, kRadius);
      report.worst_residual = std::max(report.worst_residual, residual);
    }
    report.least_clearance = std::min(report.least_clearance, judge::clearance(snapshot, state.position, kRadius));
  }
  return report;
}

// A soup of 2 x 200 x 200 small triangles in one plane that is turned so that no coordinate is exact.
TEST(C02Slide, TheSeamsOfAFlatSheetAreNotFelt) {
  const Mat3 turn = (Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.7, Vec3::UnitY())).toRotationMatrix();
  Model model =
      judge::grid(200, 200, [&](double u, double v) { return Vec3(turn * Vec3(0.1 * u - 0.05, 0.1 * v - 0.05, 0)); });
  const auto snapshot = judge::scene(model);
  ProxyState state = startProxy(*snapshot, kSettings, turn * Vec3(-0.04, -0.03, 0.01));
  double worst_angle = 0;
  for (const double depth : {1e-4, 2e-3, 0.05}) {
    for (int i = 0; i <= 2000; ++i) {
      const double s = i / 2000.0;
      const Vec3 finger = turn * Vec3(-0.04 + 0.08 * s, -0.03 + 0.05 * s * s, kRadius - depth);
      tick(state, *snapshot, kSettings, finger);
      const Vec3 force = state.position - finger;
      worst_angle = std::max(worst_angle, std::atan2(force.cross(turn.col(2)).norm(), force.dot(turn.col(2))));
    }
    tick(state, *snapshot, kSettings, turn * Vec3(-0.04, -0.03, 0.01));
  }
  std::printf("force off the normal: %.3g degrees at most\n", worst_angle * 180 / M_PI);
  EXPECT_LT(worst_angle * 180 / M_PI, 0.01);
}

// A concave half pipe of radius 20 mm along y, finger outside it by `depth`, across and along at once.
void slideInPipe(double facet, double depth, double speed) {
  constexpr double kPipe = 0.02;
  constexpr double kLength = 0.02;
  const auto around = static_cast<std::uint32_t>(std::ceil(M_PI * kPipe / facet));
  const auto along = static_cast<std::uint32_t>(std::ceil(kLength / facet));
  Model model = judge::grid(around, along, [&](double u, double v) {
    return Vec3(-kPipe * std::cos(M_PI * u), kLength * v, -kPipe * std::sin(M_PI * u));
  });
  const auto snapshot = judge::scene(model);
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(-0.01, 0.002, -0.001));
  const double rho = kPipe + depth;
  double behind = 0;
  const SlideReport report = slide(
      *snapshot,
      [&](double t) {
        const double angle = M_PI * (0.1 + 0.8 * t);
        const Vec3 finger(-rho * std::cos(angle), 0.002 + 0.015 * t, -rho * std::sin(angle));
        if (t > 0.02) {  // the state is that of the tick before: one tick of travel is not "behind"
          const double at = std::atan2(-state.position.z(), -state.position.x());
          behind = std::max(behind, std::abs(angle - at) * kPipe - speed * kPeriod_s);
        }
        return finger;
      },
      rho * 0.8 * M_PI, speed, state);
  std::printf(
      "pipe %.2f mm facets, %.1f mm deep, %.2f m/s: behind %.4f mm, residual %.2g, iterations <= %d, capped %d\n",
      facet * 1e3, depth * 1e3, speed, behind * 1e3, report.worst_residual, report.most_iterations, report.capped);
  EXPECT_LE(behind, facet);
  EXPECT_LE(report.worst_residual, 1e-6);
  EXPECT_GE(report.least_clearance, kRadius * (1 - 1e-6));
  EXPECT_EQ(report.capped, 0);
}

TEST(Slide, ConcavePipeOfQuarterMillimetreFacets) { slideInPipe(0.28e-3, 1e-3, 0.15); }
TEST(Slide, ConcavePipeOfTenthMillimetreFacets) { slideInPipe(0.1e-3, 1e-3, 0.15); }
TEST(Slide, ConcavePipeWithAFingerFiftyMillimetresDeep) { slideInPipe(0.28e-3, 50e-3, 0.15); }
TEST(Slide, ConcavePipeAtOneMetrePerSecond) { slideInPipe(0.1e-3, 2e-3, 1.0); }

Model hills(std::uint32_t cells) {
  return judge::grid(cells, cells, [](double u, double v) {
    const double x = 0.2 * u - 0.1;
    const double y = 0.2 * v - 0.1;
    const double z = 0.008 * std::sin(40 * x) * std::cos(33 * y) + 0.003 * std::sin(110 * x + 1) * std::sin(95 * y);
    return Vec3(x, y, z);
  });
}

void slideOnHills(std::uint32_t cells, double depth, double speed) {
  const auto snapshot = judge::scene(hills(cells));
  ProxyState state = startProxy(*snapshot, kSettings, Vec3(-0.08, -0.07, 0.03));
  const SlideReport report = slide(
      *snapshot,
      [&](double t) {
        const double a = 6 * t;
        return Vec3(0.08 * std::sin(a - 1.5), 0.07 * std::cos(1.7 * a), -depth);
      },
      1.0, speed, state);
  std::printf(
      "hills of %u triangles, %.0f mm deep, %.2f m/s: residual %.2g, iterations <= %d, out of work %d, capped %d\n",
      2 * cells * cells, depth * 1e3, speed, report.worst_residual, report.most_iterations, report.out_of_work,
      report.capped);
  EXPECT_LE(report.worst_residual, 1e-6);
  EXPECT_LE(report.out_of_work, 20) << "the jump onto the terrain";
  EXPECT_GE(report.least_clearance, kRadius * (1 - 1e-6));
  EXPECT_EQ(report.capped, 0);
}

TEST(Slide, ConcaveTerrainOfAHundredThousandTriangles) { slideOnHills(224, 0.012, 0.15); }
TEST(Slide, ConcaveTerrainOfAMillionTriangles) { slideOnHills(707, 0.012, 0.15); }
TEST(Slide, ConcaveTerrainWithADeepFinger) { slideOnHills(500, 0.050, 0.15); }
TEST(Slide, ConcaveTerrainAtOneMetrePerSecond) { slideOnHills(500, 0.012, 1.0); }

}  // namespace
}  // namespace hl::test_proxy_slide
