// A height field touched: the same bits as the same triangles as a mesh.
#include <gtest/gtest.h>

#include "base/realtime_guard.h"
#include "fields.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl {
namespace {

std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const Shape> shape, const Pose& pose = {}) {
  Instance instance;
  instance.shape = std::move(shape);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  instance.motion = Motion(pose);
  return makeSnapshot({std::move(instance)});
}

Model modelOf(const HeightField& field) {
  DrawnMesh drawn = field.drawn(~std::size_t{0});
  Model model;
  model.positions = std::move(drawn.positions);
  model.normals = std::move(drawn.normals);
  model.triangles = std::move(drawn.triangles);
  return model;
}

// Hills of 30 mm over 200 mm.
std::shared_ptr<const HeightField> hills(std::uint32_t side) {
  const double h = 0.2 / (side - 1);
  return test::fieldOf(side, side, h, [h](double i, double j) {
    const double x = h * i - 0.1, z = h * j - 0.1;
    return 0.009 * std::sin(40 * x) * std::cos(33 * z) + 0.004 * std::sin(87 * x + 51 * z);
  });
}

TEST(HeightTouch, AFieldIsTheSameMeshBitByBit) {
  const auto field = hills(150);
  test::Random random(1);
  for (const bool smooth : {false, true}) {
    for (const double radius : {2e-4, 1e-3, 1e-2}) {
      const auto on_request = sceneOf(makeShape(field)), mesh = sceneOf(makeShape(modelOf(*field)));
      ProxySettings settings;
      settings.radius = radius;
      settings.work_cap = kNoWorkCap;  // another index does other work
      settings.surfaces.smooth = smooth;
      settings.surfaces.static_friction = 0.3;
      settings.surfaces.dynamic_friction = 0.2;
      Vec3 finger(0.1, 0.03, 0.1);
      ProxyState a = startProxy(*on_request, settings, finger), b = startProxy(*mesh, settings, finger);
      int touched = 0;
      for (int i = 0; i < 3000; ++i) {
        finger += 4e-4 * random.inCube(1) - 0.003 * (finger - Vec3(0.1, -0.005, 0.1));
        const TickReport one = tick(a, *on_request, settings, finger), other = tick(b, *mesh, settings, finger);
        ASSERT_EQ(a.position, b.position) << i;
        ASSERT_EQ(one.iterations, other.iterations) << i;
        ASSERT_EQ(one.contacts.size(), other.contacts.size()) << i;
        touched += one.contacts.empty() ? 0 : 1;
      }
      EXPECT_GT(touched, 500);
    }
  }
}

// Over a plane of any slope the proxy stays at its radius.
TEST(HeightTouch, APlaneIsFlat) {
  for (const double slope : {0.0, 0.25, -1.5}) {
    const double h = 1e-3;
    const auto field = test::fieldOf(201, 201, h, [&](double i, double) { return slope * h * i; });
    const auto scene = sceneOf(makeShape(field));
    ProxySettings settings;
    settings.radius = 2e-3;
    const Vec3 normal = Vec3(-slope, 1, 0).normalized(), along = Vec3(1, slope, 0.3).normalized();
    const Vec3 begin(0.05, 0.05 * slope, 0.1);
    ProxyState state = startProxy(*scene, settings, begin + 0.01 * normal);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      tick(state, *scene, settings, begin + 5e-5 * i * along - std::min(0.003, 1e-4 * i) * normal);
      if (i > 200) worst = std::max(worst, std::abs((state.position - begin).dot(normal) - settings.radius));
    }
    EXPECT_LT(worst, 1e-8) << slope;  // the samples are float
  }
}

// A ball of a radius above a sine of curvature above 1/r stands on two crests: lowest centre where it touches both.
TEST(HeightTouch, ABallStandsOnCrests) {
  const double h = 5e-5, amplitude = 5e-4, wavelength = 2e-3, radius = 5e-3;
  const auto field =
      test::fieldOf(801, 81, h, [&](double i, double) { return amplitude * std::cos(2 * M_PI * h * i / wavelength); });
  const auto scene = sceneOf(makeShape(field));
  ProxySettings settings;
  settings.radius = radius;
  const auto restAt = [&](double x) {
    const Vec3 finger(x, -1e-3, 40 * h);
    ProxyState state = startProxy(*scene, settings, Vec3(x, 0.02, 40 * h));
    for (int i = 0; i < 100; ++i) tick(state, *scene, settings, finger);
    return state.position;
  };
  // At rest between two crests, whichever way it slid: brute force over the samples.
  const Vec3 rest = restAt(10.5 * wavelength);
  double lowest = -1;
  for (int i = 0; i <= 800; ++i) {
    const double d = h * i - rest.x();
    if (std::abs(d) < radius)
      lowest =
          std::max(lowest, amplitude * std::cos(2 * M_PI * h * i / wavelength) + std::sqrt(radius * radius - d * d));
  }
  EXPECT_NEAR(rest.y(), lowest, 1e-6);
  EXPECT_LT(rest.y(), amplitude + radius);
}

TEST(HeightTouch, TicksAllocateNothing) {
  const auto field = hills(500);
  const auto scene = sceneOf(makeShape(field));
  ProxySettings settings;
  settings.radius = 1e-3;
  Vec3 finger(0.1, 0.03, 0.1);
  ProxyState state = startProxy(*scene, settings, finger);
  const RealtimeGuard guard;
  for (int i = 0; i < 500; ++i) {
    finger += Vec3(5e-5, i < 200 ? -2e-4 : 0, 2e-5);
    tick(state, *scene, settings, finger);
  }
  EXPECT_LT(state.position.x(), 0.2);
}

}  // namespace
}  // namespace hl
