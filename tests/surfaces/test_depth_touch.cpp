// A depth camera's images under a finger, frame after frame: the proxy stays on the camera's side, a radius away.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cases.h"
#include "fields.h"
#include "proxy/leave_matter.h"
#include "proxy/proxy.h"
#include "surfaces/depth_frame.h"

namespace hl::test_depth_touch {
namespace {

constexpr std::uint32_t kColumns = 80, kRows = 60;
const DepthCamera kCamera{70, 70, 40, 30};

double wallAt(double time_s) { return 0.5 + 0.02 * std::sin(2 * time_s); }

/// A wall that comes and goes, with a hump of 40 mm that wanders over it, as a camera with noise of sigma_m measures
/// them: in millimetres. A pixel in fifty is missing.
std::shared_ptr<const HeightGrid> seen(double time_s, double sigma_m, std::mt19937& random) {
  std::normal_distribution<double> noise(0, sigma_m);
  std::uniform_int_distribution<int> luck(0, 49);
  const Vec2 hump(40 + 15 * std::sin(time_s), 30);
  std::vector<std::uint16_t> depths;
  for (std::uint32_t j = 0; j < kRows; ++j) {
    for (std::uint32_t i = 0; i < kColumns; ++i) {
      const double depth = wallAt(time_s) - 0.04 * std::exp(-(Vec2(i, j) - hump).squaredNorm() / 100);
      depths.push_back(luck(random) == 0 ? 0 : static_cast<std::uint16_t>(std::lround(1e3 * (depth + noise(random)))));
    }
  }
  return test::gridOf(kColumns, kRows, depths);
}

/// What a server shows of a camera.
class Shown {
 public:
  void show(const HeightGrid& depths, double smoothing) {
    const auto image = smoothed(depths, 1e-3, kCamera, image_.get(), smoothing);
    Instance instance;
    instance.shape = makeShape(std::make_shared<const DepthFrame>(image, cameraFrame(1)));
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = 1;
    instance.replaced_in = image_ ? number_ + 1 : 0;
    snapshot_ = makeSnapshot({instance}, "", ++number_);
    image_ = image;
  }
  const Snapshot& snapshot() const { return *snapshot_; }

 private:
  std::uint64_t number_ = 0;
  std::shared_ptr<const DepthImage> image_;
  std::shared_ptr<const Snapshot> snapshot_;
};

double clearance(const SceneAt& scene, const Vec3& position, double reach) {
  double nearest = reach;
  scene.primitivesWithin(position, reach,
                         [&](PrimitiveId, const ClosestPoint& at) { nearest = std::min(nearest, at.distance); });
  return nearest;
}

// At 30 Hz with ticks between; a finger that presses all the time, on the wall and on the hump.
TEST(DepthTouch, TheProxyStaysOnTheSideOfTheCamera) {
  std::mt19937 random(3);
  Shown shown;
  for (int i = 0; i < 5; ++i) shown.show(*seen(0, 6e-4, random), 0.5);
  ProxySettings settings;
  settings.radius = 0.01;
  const auto fingerAt = [](double time_s) {
    return Vec3(0.12 * std::sin(0.7 * time_s), 0.05 * std::cos(1.1 * time_s), -0.54);
  };
  ProxyState state = startProxy(shown.snapshot(), settings, {0, 0, -0.2});
  const int frames = 30 * test::cases(20);
  int touched = 0, behind = 0;
  for (int frame = 1; frame <= frames; ++frame) {
    shown.show(*seen(frame / 30.0, 6e-4, random), 0.5);
    const SceneAt scene(shown.snapshot());
    for (int i = 0; i < 8; ++i) {
      const TickReport report = tick(state, scene, settings, fingerAt((frame + i / 8.0) / 30));
      touched += report.contacts.empty() ? 0 : 1;
      ASSERT_GE(clearance(scene, state.position, 2 * settings.radius), settings.radius * (1 - 1e-6)) << frame;
    }
    behind += -state.position.z() > wallAt(frame / 30.0) ? 1 : 0;
  }
  EXPECT_GT(touched, 3 * frames);
  EXPECT_EQ(behind, 0);
}

// Behind a wall, as it went around its rim, with a finger that goes on into it: the wall comes nearer than the radius.
TEST(DepthTouch, WhatIsBehindTheSurfaceStaysThere) {
  ProxySettings settings;
  settings.radius = 0.002;
  const auto wall = [](float depth_m) {
    return test::gridOf(kColumns, kRows, std::vector<float>(std::size_t{kColumns} * kRows, 1e3F * depth_m));
  };
  for (const Vec3& ahead : {Vec3(0, 0, -0.001), Vec3(0.001, 0, -0.001), Vec3(0, 0, 0), Vec3(0, 0.003, 0.001)}) {
    Shown shown;
    shown.show(*wall(0.5F), 0);
    ProxyState state;
    state.free = true;
    state.position = Vec3(0.01, 0.02, -0.503);
    tick(state, shown.snapshot(), settings, state.position);
    ASSERT_EQ(state.within.size(), 1U);
    shown.show(*wall(0.502F), 0);
    leaveMatter(state, shown.snapshot(), settings, state.position + ahead);
    EXPECT_LT(state.position.z(), -0.502 - 0.9999 * settings.radius);
    EXPECT_GT(state.position.z(), -0.52);
  }
}

// A still wall of noise as of a camera half a metre away, under a ball that is larger than its pixels: at rest.
TEST(DepthTouch, NoiseAtRestIsHardlyFelt) {
  std::mt19937 random(4);
  Shown shown;
  const auto wall = [&] {
    std::normal_distribution<double> noise(0, 0.63e-3);
    std::vector<float> depths(std::size_t{kColumns} * kRows);
    for (float& depth : depths) depth = static_cast<float>(1e3 * (0.5 + noise(random)));
    return test::gridOf(kColumns, kRows, depths);
  };
  for (int i = 0; i < 300; ++i) shown.show(*wall(), 0.98);
  ProxySettings settings;
  settings.radius = 0.01;
  ProxyState state = startProxy(shown.snapshot(), settings, {0, 0, -0.2});
  const Vec3 finger(0.003, 0.002, -0.492);  // 2 N on a wall without noise
  double sum_N2 = 0, mean_N = 0;
  constexpr int kFrames = 200;
  for (int i = -20; i < kFrames; ++i) {
    shown.show(*wall(), 0.98);
    TickReport report;
    for (int j = 0; j < 8; ++j) report = tick(state, shown.snapshot(), settings, finger);
    const double force_N = settings.spring_N_m * (report.target - finger).norm();
    if (i < 0) continue;
    sum_N2 += force_N * force_N / kFrames;
    mean_N += force_N / kFrames;
  }
  EXPECT_NEAR(mean_N, 2, 0.3);
  EXPECT_LT(std::sqrt(std::max(0.0, sum_N2 - mean_N * mean_N)), 0.05);
}

}  // namespace
}  // namespace hl::test_depth_touch
