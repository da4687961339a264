// Clouds touched: how far a ball sinks between points, and that surfels are flat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clouds.h"
#include "guard/realtime_guard.h"
#include "proxy/proxy.h"
#include "scene/scene_model.h"

namespace hl::test_cloud_touch {
namespace {

constexpr double kRadius = 1e-3;

std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const PrimitiveSource> source) {
  SceneModel scene;
  scene.surfaces.push_back({"cloud", std::move(source)});
  return makeSnapshot(std::move(scene));
}

std::shared_ptr<const Snapshot> gridScene(double spacing, const CloudLook& look) {
  return sceneOf(std::make_shared<const PointCloud>(test::cloudOf(test::squareGrid(80, spacing)), look));
}

// Pressed 1 mm deep in the middle between four points.
double restingHeight(const Snapshot& scene, double spacing) {
  ProxySettings settings;
  settings.radius = kRadius;
  const Vec3 middle(0.5 * spacing, 0, 0.5 * spacing);
  ProxyState state = startProxy(scene, settings, middle + Vec3(0, 3e-3, 0));
  for (int i = 0; i <= 400; ++i) tick(state, scene, settings, middle + Vec3(0, 3e-3 - 1e-5 * i, 0));
  return state.position.y();
}

// A ball of r rests on four points at s / sqrt 2 from its axis.
TEST(CloudTouch, ABallSinksBetweenPointsByTheClosedForm) {
  for (const double spacing : {0.25e-3, 0.5e-3, 1e-3}) {
    const double sinks = kRadius - std::sqrt(kRadius * kRadius - spacing * spacing / 2);
    EXPECT_NEAR(restingHeight(*gridScene(spacing, CloudLook{}), spacing), kRadius - sinks, 2e-4 * spacing) << spacing;
  }
  EXPECT_NEAR(kRadius - restingHeight(*gridScene(0.25e-3, {}), 0.25e-3), 15.7e-6, 0.1e-6);
  EXPECT_NEAR(kRadius - restingHeight(*gridScene(0.5e-3, {}), 0.5e-3), 64.6e-6, 0.1e-6);
}

TEST(CloudTouch, ABallPassesBetweenPointsThatAreTooFarApart) {
  EXPECT_LT(restingHeight(*gridScene(1.42e-3, CloudLook{}), 1.42e-3), -0.9e-3);
  EXPECT_GT(restingHeight(*gridScene(1.41e-3, CloudLook{}), 1.41e-3), 0);
}

struct Slide {
  double lowest = 1, highest = -1, turn = 0;  // of the proxy, m; of the force from the vertical, rad
};

Slide slide(const Snapshot& scene, bool smooth) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.surfaces.smooth = smooth;
  Vec3 finger(-0.004, 2e-3, 0.0011);
  ProxyState state = startProxy(scene, settings, finger);
  Slide felt;
  for (int i = 0; i < 1500; ++i) {
    finger.y() = std::max(-1e-3, finger.y() - 2e-5);
    if (i > 300) finger += Vec3(6e-6, 0, 1.7e-6);
    const RealtimeGuard guard;
    tick(state, scene, settings, finger);
    if (i < 300) continue;
    felt.lowest = std::min(felt.lowest, state.position.y());
    felt.highest = std::max(felt.highest, state.position.y());
    const Vec3 pull = (state.position - finger).normalized();
    felt.turn = std::max(felt.turn, std::hypot(pull.x(), pull.z()));
  }
  return felt;
}

TEST(CloudTouch, SurfelsOfAPlaneAreFlat) {
  for (const double spacing : {0.25e-3, 0.5e-3, 2e-3}) {
    const auto scene = gridScene(spacing, CloudLook{CloudForm::kSurfels});
    EXPECT_NEAR(restingHeight(*scene, spacing), kRadius, 1e-4 * spacing);
    const Slide felt = slide(*scene, false);
    EXPECT_NEAR(felt.lowest, kRadius, 1e-4 * spacing);
    EXPECT_NEAR(felt.highest, kRadius, 1e-4 * spacing);
  }
}

// Points have the cobbles of their grid; the force is as upright as that of a plane, almost.
TEST(CloudTouch, NormalsMakeTheForceSmooth) {
  const auto scene = gridScene(0.25e-3, CloudLook{});
  const Slide cobbled = slide(*scene, false), shaded = slide(*scene, true);
  RecordProperty("cobbled_mrad", std::to_string(1e3 * cobbled.turn));
  RecordProperty("shaded_mrad", std::to_string(1e3 * shaded.turn));
  EXPECT_LT(shaded.turn, 0.5 * cobbled.turn);
  EXPECT_GE(shaded.lowest, kRadius - 15.8e-6);
  EXPECT_LE(shaded.highest, kRadius + 1e-9);
}

// From both sides, at random: a ball never enters a sphere of surfels, nor leaves it.
TEST(CloudTouch, NothingFallsThroughSurfels) {
  test::Random random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 4000; ++i) {
    const double y = 1 - 2 * (i + 0.5) / 4000, angle = 2.399963229728653 * i;
    points.emplace_back(0.02 * Vec3(std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle)));
  }
  const auto scene = sceneOf(std::make_shared<const PointCloud>(test::cloudOf(points), CloudLook{CloudForm::kSurfels}));
  ProxySettings settings;
  settings.radius = kRadius;
  for (const double side : {1.0, -1.0}) {
    Vec3 finger(0, side > 0 ? 0.03 : 0.0, 0);
    ProxyState state = startProxy(*scene, settings, finger);
    for (int i = 0; i < 5000; ++i) {
      finger += 1e-3 * random.inCube(1) - 0.01 * (finger - 0.02 * finger.normalized());
      tick(state, *scene, settings, finger);
      ASSERT_GT(side * (state.position.norm() - 0.02), 0.9 * kRadius) << i;
    }
  }
}

}  // namespace
}  // namespace hl::test_cloud_touch
