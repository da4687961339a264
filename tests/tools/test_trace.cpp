// Traces over models: outside the surface at every tick, at the local minimum at every tick, the same bits every time.
// HL_TEST_MODELS=FOLDER adds the model files of a folder.
#include "tools/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "geometry/queries.h"
#include "io/load_scene.h"
#include "proxy/solver.h"

namespace hl::test_trace {
namespace {

constexpr double kSide = 0.2;

// In and out of the model and straight through its middle, at up to 0.3 m/s, each time in another direction.
std::vector<PathSample> crossingPath(double amplitude, double phase) {
  std::vector<PathSample> path;
  for (int i = 0; i < 12'000; ++i) {
    const double t = 1e-3 * i;
    const double azimuth = 0.5 * t + phase;
    const double height = std::sin(0.9 * t + 2 * phase);
    const Vec3 direction = Vec3(std::cos(azimuth), height, std::sin(azimuth)).normalized();
    path.push_back({t, amplitude * std::sin(2.2 * t + M_PI / 2) * direction});
  }
  return path;
}

struct Judgement {
  double least_clearance = 1e9;
  double worst_residual = 0;
  double fastest = 0;
  double nearest_middle = 1e9;  // m, of the proxy to the origin
  TraceTotals totals;
};

Judgement judge(const Snapshot& snapshot, double radius, double phase, const MaterialOverride& surfaces = {}) {
  Judgement result;
  TraceSettings settings;
  settings.proxy.radius = radius;
  settings.proxy.surfaces = surfaces;
  const auto path = crossingPath(0.55 * kSide, phase);
  Vec3 last = path.front().position;
  result.totals = runTrace(snapshot, settings, path, [&](const TraceRow& row) {
    result.fastest = std::max(result.fastest, (row.finger - last).norm() / 1e-3);
    last = row.finger;
    result.nearest_middle = std::min(result.nearest_middle, row.proxy.norm());
    std::vector<Plane> planes;
    SceneAt(snapshot).primitivesWithin(row.proxy, radius * (1 + 1e-6), [&](PrimitiveId, const ClosestPoint& c) {
      planes.push_back({c.normal, 0});
      result.least_clearance = std::min(result.least_clearance, c.distance);
    });
    const Vec3 gap = row.finger - row.proxy;
    if (gap.norm() < 1e-9) return;
    const double residual = nearestAbove(planes, gap.normalized(), 1e-12).point.norm();
    result.worst_residual = std::max(result.worst_residual, residual);
  });
  return result;
}

// Ticks that ended at a valid place before the local minimum.
std::uint64_t cutShort(const EndingCounts& ended) { return ended.capped() + ended[Ending::kOutOfWork]; }

// Returns the ticks in contact.
std::uint64_t expectSound(Model model, const std::string& spec) {
  std::uint64_t contacts = 0;
  fitModel(model, kSide);
  const auto snapshot = makeSnapshot(std::move(model), HierarchyKind::kBvh);
  for (const double phase : {0.0, 2.0}) {
    const Judgement j = judge(*snapshot, 1e-3, phase);
    std::printf(
        "%s: clearance - r >= %.2g r, residual <= %.2g, %.2f m/s, %llu of %llu ticks in contact, %llu cut short\n",
        spec.c_str(), j.least_clearance / 1e-3 - 1, j.worst_residual, j.fastest,
        static_cast<unsigned long long>(j.totals.contacts), static_cast<unsigned long long>(j.totals.ticks),
        static_cast<unsigned long long>(cutShort(j.totals.ended)));
    EXPECT_GE(j.least_clearance, 1e-3 * (1 - 1e-6)) << spec;
    if (cutShort(j.totals.ended) == 0) {
      EXPECT_LE(j.worst_residual, 1e-6) << spec;
    }
    EXPECT_LE(j.fastest, 0.31);
    contacts += j.totals.contacts;
  }
  return contacts;
}

// Every file of a folder that loads; flat and tiny ones may be missed by the path, all of them together are not.
void expectFolderSound(const std::string& folder, std::size_t most_triangles) {
  std::uint64_t contacts = 0;
  int traced = 0, refused = 0, large = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    Model model;
    try {
      model = loadScene(entry.path().string()).model;
    } catch (const Error&) {
      ++refused;
      continue;
    }
    if (model.elements() > most_triangles) {
      ++large;
      continue;
    }
    contacts += expectSound(std::move(model), entry.path().string());
    ++traced;
  }
  std::printf("%s: %d files traced, %d refused by the reader, %d too large; %llu ticks in contact\n", folder.c_str(),
              traced, refused, large, static_cast<unsigned long long>(contacts));
  EXPECT_GT(contacts, 500u);
}

TEST(Trace, TheTeapotAndTheWalkerHoldTheProxyAtItsLocalMinimum) {
  for (const char* spec : {"teapot", "walker", "sphere:20000"})
    EXPECT_GT(expectSound(loadScene(spec).model, spec), 500u) << spec;
}

// Surfaces only change where the proxy goes: it stays outside, and no energy comes from nowhere.
TEST(Trace, ShadingAndFrictionKeepTheProxyOutside) {
  MaterialOverride surfaces;
  surfaces.smooth = true;
  surfaces.static_friction = 0.5;
  surfaces.dynamic_friction = 0.3;
  surfaces.viscosity_Ns_m = 1;
  for (const char* spec : {"teapot", "walker", "sphere:20000", "terrain:5000"}) {
    Model model = loadScene(spec).model;
    fitModel(model, kSide);
    const auto snapshot = makeSnapshot(std::move(model), HierarchyKind::kBvh);
    const Judgement j = judge(*snapshot, 1e-3, 1.0, surfaces);
    EXPECT_GE(j.least_clearance, 1e-3 * (1 - 1e-6)) << spec;
    EXPECT_EQ(j.totals.ended.capped(), 0u) << spec;
    EXPECT_GT(j.totals.contacts, 500u) << spec;
    EXPECT_GT(j.totals.ledger.dissipated_J, j.totals.ledger.injected_J) << spec;
  }
}

TEST(Trace, AClosedSurfaceIsNeverCutThrough) {
  const auto snapshot = makeSnapshot(loadScene("sphere:20000"), HierarchyKind::kBvh);
  for (const double phase : {0.5, 1.0, 1.5}) EXPECT_GT(judge(*snapshot, 1e-3, phase).nearest_middle, 0.096);
}

TEST(Trace, ModelFilesHoldTheProxyAtItsLocalMinimum) {
  const char* folder = std::getenv("HL_TEST_MODELS");
  if (folder == nullptr) GTEST_SKIP() << "set HL_TEST_MODELS to a folder of model files";
  expectFolderSound(folder, 10'000'000);
}

TEST(Trace, DebiansTestModelsHoldTheProxyAtItsLocalMinimum) {
  const std::string folder = "/usr/share/assimp/models";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  expectFolderSound(folder, 20'000);
}

TEST(Trace, TheSameBitsEveryTimeAndWithoutTheHierarchy) {
  Model model = loadScene("teapot").model;
  const auto tree = makeSnapshot(model, HierarchyKind::kBvh);
  const auto none = makeSnapshot(model, HierarchyKind::kNone);
  auto path = crossingPath(0.11, 0.3);
  path.resize(1500);
  std::vector<Vec3> first, second, third;
  runTrace(*tree, {}, path, [&](const TraceRow& row) { first.push_back(row.force); });
  runTrace(*tree, {}, path, [&](const TraceRow& row) { second.push_back(row.force); });
  runTrace(*none, {}, path, [&](const TraceRow& row) { third.push_back(row.force); });
  EXPECT_EQ(first, second);
  EXPECT_EQ(first, third);
}

// Along x through two points, each taken at 1 mm and left at 2 mm.
TEST(Trace, ReportsWhichSnapHolds) {
  SceneModel model;
  model.snaps = {{"a", {Vec3(0.01, 0, 0)}, {}, 1e-3, 2}, {"b", {Vec3(0.02, 0, 0)}, {}, 1e-3, 2}};
  const auto scene = makeSnapshot(std::move(model));
  std::vector<PathSample> path;
  for (int i = 0; i < 300; ++i) path.push_back({1e-3 * i, Vec3(1e-4 * i + 1e-6, 0, 0)});
  std::vector<std::size_t> held;
  runTrace(*scene, {}, path, [&](const TraceRow& row) { held.push_back(row.snap.value_or(9)); });
  for (std::size_t i = 0; i < held.size(); ++i) {
    const std::size_t expected = i >= 90 && i < 120 ? 1 : i >= 190 && i < 220 ? 2 : 0;
    ASSERT_EQ(held[i], expected) << i;
  }
}

}  // namespace
}  // namespace hl::test_trace
