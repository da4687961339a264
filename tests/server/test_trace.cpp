// Traces over models: outside the surface at every tick, at the local minimum at every tick, the same bits every time.
// HL_TEST_MODELS=FOLDER adds the model files of a folder.
#include "server/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "geometry/queries.h"
#include "io/load_scene.h"
#include "proxy/solver.h"

namespace hl {
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

Judgement judge(const Snapshot& snapshot, double radius, double phase) {
  Judgement result;
  TraceSettings settings;
  settings.proxy.radius = radius;
  const auto path = crossingPath(0.55 * kSide, phase);
  Vec3 last = path.front().position;
  result.totals = runTrace(snapshot, settings, path, [&](const TraceRow& row) {
    result.fastest = std::max(result.fastest, (row.finger - last).norm() / 1e-3);
    last = row.finger;
    result.nearest_middle = std::min(result.nearest_middle, row.proxy.norm());
    std::vector<Plane> planes;
    primitivesWithin(*snapshot.index, snapshot.primitives, row.proxy, radius * (1 + 1e-6),
                     [&](std::uint32_t, const ClosestPoint& c) {
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

void expectSound(const std::string& spec) {
  Model model = loadScene(spec);
  fitModel(model, kSide);
  const auto snapshot = makeSnapshot(std::move(model), HierarchyKind::kSpheres);
  for (const double phase : {0.0, 2.0}) {
    const Judgement j = judge(*snapshot, 1e-3, phase);
    std::printf("%s: clearance - r >= %.2g r, residual <= %.2g, %.2f m/s, %llu of %llu ticks in contact, %llu capped\n",
                spec.c_str(), j.least_clearance / 1e-3 - 1, j.worst_residual, j.fastest,
                static_cast<unsigned long long>(j.totals.contacts), static_cast<unsigned long long>(j.totals.ticks),
                static_cast<unsigned long long>(j.totals.capped));
    EXPECT_GE(j.least_clearance, 1e-3 * (1 - 1e-6)) << spec;
    if (j.totals.capped == 0) {
      EXPECT_LE(j.worst_residual, 1e-6) << spec;
    }
    EXPECT_LE(j.fastest, 0.31);
    EXPECT_GT(j.totals.contacts, 500u) << spec;
  }
}

TEST(Trace, TheTeapotAndTheWalkerHoldTheProxyAtItsLocalMinimum) {
  expectSound("teapot");
  expectSound("walker");
  expectSound("sphere:20000");
}

TEST(Trace, AClosedSurfaceIsNeverCutThrough) {
  const auto snapshot = makeSnapshot(loadScene("sphere:20000"), HierarchyKind::kSpheres);
  for (const double phase : {0.5, 1.0, 1.5}) EXPECT_GT(judge(*snapshot, 1e-3, phase).nearest_middle, 0.096);
}

TEST(Trace, ModelFilesHoldTheProxyAtItsLocalMinimum) {
  const char* folder = std::getenv("HL_TEST_MODELS");
  if (folder == nullptr) GTEST_SKIP() << "set HL_TEST_MODELS to a folder of model files";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) expectSound(entry.path().string());
}

TEST(Trace, TheSameBitsEveryTimeAndWithoutTheHierarchy) {
  Model model = loadScene("teapot");
  const auto tree = makeSnapshot(model, HierarchyKind::kSpheres);
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

}  // namespace
}  // namespace hl
