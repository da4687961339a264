// Volumes touched: as the same triangles as a mesh.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "base/error.h"
#include "guard/realtime_guard.h"
#include "proxy/proxy.h"
#include "scene/iso_shape.h"
#include "scene/scene_model.h"
#include "surfaces/threshold.h"
#include "volumes.h"

namespace hl::test_iso_touch {
namespace {

std::shared_ptr<const Snapshot> sceneOf(std::shared_ptr<const Shape> shape) {
  Instance instance;
  instance.shape = std::move(shape);
  instance.surfaces = surfacesOf(instance.shape);
  instance.key = 1;
  return makeSnapshot({std::move(instance)});
}

Model modelOf(const IsoSurface& surface) {
  DrawnMesh drawn = surface.drawn(~std::size_t{0});
  Model model;
  model.positions = std::move(drawn.positions);
  model.triangles = std::move(drawn.triangles);
  return model;
}

// A lump of 60 mm with waves, in a volume of 100 mm.
std::shared_ptr<const IsoSurface> lump(std::uint32_t side) {
  const double h = 0.1 / (side - 1);
  const auto volume = test::volumeOf({side, side, side}, [h](const Vec3& at) {
    const Vec3 p = h * at - Vec3::Constant(0.05);
    return 1000 * (0.03 - p.norm()) + 2 * std::sin(400 * p.x()) * std::cos(330 * p.y()) * std::sin(270 * p.z() + 1);
  });
  return std::make_shared<const IsoSurface>(volume, test::cubicFrame(h, Vec3::Constant(-0.05)), IsoValue{0});
}

TEST(IsoTouch, ASurfaceIsFeltAsTheSameMesh) {
  const auto surface = lump(60);
  const auto on_request = sceneOf(makeShape(surface)), mesh = sceneOf(makeShape(modelOf(*surface)));
  test::Random random(1);
  for (const double radius : {2e-4, 1e-3, 1e-2}) {
    ProxySettings settings;
    settings.radius = radius;
    settings.work_cap = kNoWorkCap;    // another index does other work
    settings.surfaces.smooth = false;  // the mesh has no normals
    Vec3 finger(0, 0.05, 0);
    ProxyState a = startProxy(*on_request, settings, finger), b = startProxy(*mesh, settings, finger);
    int touched = 0;
    for (int i = 0; i < 3000; ++i) {
      finger += 8e-4 * random.inCube(1) - 0.003 * (finger - 0.03 * finger.normalized());
      const TickReport one = tick(a, *on_request, settings, finger);
      tick(b, *mesh, settings, finger);
      ASSERT_LT((a.position - b.position).norm(), 1e-9) << i;
      touched += one.contacts.empty() ? 0 : 1;
    }
    EXPECT_GT(touched, 200);
  }
}

// A ball that grows over the finger, which is then deep below triangles much smaller than its depth.
TEST(IsoTouch, ASmoothSurfaceThatGrewOverTheFingerHoldsTheProxyStill) {
  constexpr double kSpacing = 0.1 / 60;
  const auto volume = test::volumeOf(
      {61, 61, 61}, [&](const Vec3& at) { return 1000 * (0.03 - (kSpacing * at - Vec3::Constant(0.05)).norm()); });
  test::Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 way = random.direction();
    const double grows_m = random.uniform(0.001, 0.014);
    const auto grown = std::make_shared<const IsoSurface>(volume, test::cubicFrame(kSpacing, Vec3::Constant(-0.05)),
                                                          IsoValue{-1000 * grows_m});
    const auto scene = sceneOf(makeShape(grown));
    ProxySettings settings;
    settings.radius = random.uniform(0.5e-3, 3e-3);
    settings.surfaces.smooth = true;
    const double surface_m = 0.03 + grows_m + settings.radius;
    const Vec3 finger = random.uniform(0.03, surface_m) * way;
    const Vec3 aside = way.cross(random.direction()).normalized();
    ProxyState state = startProxy(*scene, settings, (surface_m + 0.001) * (way + 0.2 * aside).normalized());
    for (int k = 0; k < 40; ++k) tick(state, *scene, settings, finger);
    EXPECT_LT((state.position - surface_m * way).norm(), 1e-4) << i;
    const Vec3 before = state.position;
    tick(state, *scene, settings, finger);
    EXPECT_LT((state.position - before).norm(), 1e-9) << i;
  }
}

// Values that are whole numbers, of a plane of any tilt: interpolation on edges is then exact but for rounding.
TEST(IsoTouch, APlaneOfAnyTiltIsFlatOver100mm) {
  constexpr std::uint32_t kSide = 121;
  constexpr double kSpacing = 1e-3;
  for (const Vec3& tilt : {Vec3(0, 7, 0), Vec3(1, 7, 0), Vec3(3, 7, 5), Vec3(-7, 7, 2), Vec3(3, 11, -13)}) {
    const Vec3 middle = Vec3::Constant(60);
    const auto volume = test::volumeOf({kSide, kSide, kSide}, [&](const Vec3& at) { return tilt.dot(at - middle); });
    const auto scene = sceneOf(makeShape(std::make_shared<const IsoSurface>(
        volume, test::cubicFrame(kSpacing, -kSpacing * middle), IsoValue{0.5, SolidSide::kBelow})));
    ProxySettings settings;
    settings.radius = 2e-3;
    const Vec3 normal = tilt.normalized(), along = normal.cross(Vec3(0.1, 0.2, 1)).normalized();
    const double height = 0.5 * kSpacing / tilt.norm();  // of the plane where the values are 0.5
    const auto fingerAt = [&](int i) { return Vec3((1e-4 * i - 0.05) * along + (height - 0.002) * normal); };
    ProxyState state = startProxy(*scene, settings, fingerAt(0) + 0.01 * normal);
    for (int i = 0; i < 50; ++i) tick(state, *scene, settings, fingerAt(0));
    double worst = 0;
    for (int i = 0; i <= 1000; ++i) {
      tick(state, *scene, settings, fingerAt(i));
      worst = std::max(worst, std::abs(state.position.dot(normal) - height - settings.radius));
    }
    EXPECT_LT((state.position - fingerAt(1000)).norm(), 0.00401) << tilt.transpose();
    EXPECT_LT(worst, 1e-12) << tilt.transpose();
  }
}

TEST(IsoTouch, TicksAllocateNothing) {
  const auto scene = sceneOf(makeShape(lump(120)));
  ProxySettings settings;
  settings.radius = 1e-3;
  settings.surfaces.smooth = true;
  Vec3 finger(0, 0.05, 0);
  ProxyState state = startProxy(*scene, settings, finger);
  const RealtimeGuard guard;
  bool touched = false;
  for (int i = 0; i < 500; ++i) {
    finger += Vec3(2e-5, i < 150 ? -2e-4 : 0, 3e-5);
    touched = !tick(state, *scene, settings, finger).contacts.empty() || touched;
  }
  EXPECT_TRUE(touched);
}

// Between two values, wherever they are and however many samples each has.
TEST(Threshold, OfTwoValuesIsInTheMiddle) {
  for (const int part : {2, 10, 100}) {
    int place = 0;
    const auto volume =
        test::volumeOf({20, 20, 20}, [&](const Vec3&) { return ++place % part == 0 ? 700.0 : -1000.0; });
    EXPECT_DOUBLE_EQ(thresholdOf(*volume), -150) << part;
  }
  EXPECT_EQ(thresholdOf(*test::volumeOf({3, 3, 3}, [](const Vec3&) { return 5.0; })), 5);
}

SceneModel twoSurfaces() {
  const auto first = lump(40);
  SceneModel scene;
  scene.surfaces.push_back({"outer", first});
  scene.surfaces.push_back(
      {"inner", std::make_shared<const IsoSurface>(first->volume(), first->frame(), IsoValue{10})});
  scene.surfaces[0].material.stiffness = 0.5;
  return scene;
}

TEST(Volumes, CountTheirSamplesOnceForAllSurfaces) {
  const SceneModel scene = twoSurfaces();
  const std::size_t samples = std::size_t{40} * 40 * 40 * sizeof(float);
  EXPECT_GT(bytesToMake(scene), samples);
  EXPECT_LT(bytesToMake(scene), 2 * samples);
  const auto snapshot = makeSnapshot(scene);
  EXPECT_GT(memoryOf(*snapshot), samples);
  EXPECT_LT(memoryOf(*snapshot), 2 * samples);
  EXPECT_GT(snapshot->shape().geometryBytes(), samples);
}

TEST(Volumes, TakeOtherIsoValues) {
  SceneModel scene = twoSurfaces();
  const auto isoOf = [&](std::size_t i) { return dynamic_cast<const IsoSurface&>(*scene.surfaces[i].source).iso(); };
  setIsoValues(scene, {1, 2, 3});
  ASSERT_EQ(scene.surfaces.size(), 3U) << "the surfaces of one volume are replaced together";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(isoOf(i).value, 1.0 + static_cast<double>(i));
    EXPECT_EQ(scene.surfaces[i].source->shared().of, scene.surfaces[0].source->shared().of);
    EXPECT_EQ(scene.surfaces[i].name, i == 0 ? "outer" : "inner");
    EXPECT_EQ(scene.surfaces[i].material.stiffness, i == 0 ? 0.5 : Material().stiffness);
  }
  setSolidSide(scene, SolidSide::kBelow);
  setIsoValues(scene, {4});
  EXPECT_EQ(isoOf(0).value, 4);
  EXPECT_EQ(isoOf(0).solid, SolidSide::kBelow) << "another value has its matter on the same side";
  EXPECT_THROW(setIsoValues(scene, {1e9}), Error);
  EXPECT_THROW(setIsoValues(scene, {4, 5, 4}), Error);
  EXPECT_THROW(scaleHeights(scene, 2), Error) << "a volume has no heights";
  SceneModel mesh;
  EXPECT_THROW(setIsoValues(mesh, {1}), Error);
  EXPECT_THROW(setSolidSide(mesh, SolidSide::kBelow), Error);
}

// Opening a scene asks for a surface; who moves the slider passes values that have none.
TEST(Volumes, AreMovedOverTheirWholeRangeAndBeyond) {
  SceneModel scene = twoSurfaces();
  const auto snapshot = makeSnapshot(scene);
  Instance instance = snapshot->instances.front();
  const ValueRange range = isoSurfaceOf(instance)->volume()->pyramid.range();
  for (const double value : {double{range.low}, double{range.high}, range.low - 1.0, range.high + 1.0, 10.0}) {
    for (const SolidSide side : {SolidSide::kAbove, SolidSide::kBelow}) {
      EXPECT_EQ(checkIsoChange(*snapshot, instance.key, {value, side}), instance.key);
      setIso(instance, {value, side});
      EXPECT_EQ(isoSurfaceOf(instance)->iso(), (IsoValue{value, side}));
    }
  }
}

}  // namespace
}  // namespace hl::test_iso_touch
