// What hl bench asks, of HL and of the libraries that it was built with: the answers are distances, and agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "builtin.h"
#include "geometry/closest_point.h"
#include "tick/interruptions.h"
#include "tick/own_queries.h"
#include "tick/peers/peers.h"
#include "tick/suite.h"

namespace hl::bench::test_peer {
namespace {

constexpr double kRadius_m = 1e-3;

struct Slide {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Snapshot> snapshot;
  std::vector<Probe> probes;
};

Slide slideOn(const std::string& scene) {
  Slide slide;
  slide.shape = makeShape(makeBuiltinScene(scene));
  slide.snapshot = makeSnapshotOf(slide.shape, Feel::kPlain);
  ProxySettings settings;
  settings.radius = kRadius_m;
  slide.probes = probesOf(planPath(*slide.snapshot, FingerMotion::kSliding, settings, 1000), kRadius_m);
  return slide;
}

// Of every triangle.
double nearestTo(const Primitives& triangles, const Vec3& p) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    nearest = std::min(nearest, closestPoint(triangles[i], p).distance);
  }
  return nearest;
}

// HL itself is not asked for what is nearest to the finger.
std::vector<double> expected(const Slide& slide, Question question) {
  if (question != Question::kFinger) {
    return timeAnswers(*makeOwnQueries(*slide.snapshot), question, slide.probes, HUGE_VAL).metres;
  }
  std::vector<double> metres;
  for (const Probe& probe : slide.probes) metres.push_back(nearestTo(slide.shape->primitives, probe.finger));
  return metres;
}

TEST(Peer, OwnQueriesOnAPlaneAreItsDistances) {
  const Slide slide = slideOn("plane:200");
  const auto own = makeOwnQueries(*slide.snapshot);
  for (const Probe& probe : slide.probes) {
    ASSERT_NEAR(own->ask(Question::kNear, probe), kRadius_m, 1e-9);
    ASSERT_LT(probe.finger.y(), probe.centre.y());
    const double fall = (probe.from.y() - kRadius_m) / -probe.motion.y();
    ASSERT_NEAR(own->ask(Question::kImpact, probe), fall * probe.motion.norm(), 1e-9);
  }
  EXPECT_NEAR(slide.probes.back().centre.y() - slide.probes.back().finger.y(), 4e-3, 1e-9);
}

TEST(Peer, OnlyWhatWeFoundIsComparedAndAMissIsADifference) {
  const double far = HUGE_VAL;
  const Agreement agreement =
      compare(std::vector<double>{1, 1, 1, far}, std::vector<double>{1 + 0.9e-5, 1 + 1.1e-5, far, 1, 1});
  EXPECT_EQ(agreement.compared, 3u);
  EXPECT_EQ(agreement.different, 2u);
}

TEST(Peer, TheOthersAgree) {
  if (peers().empty()) GTEST_SKIP() << "built without other libraries (scripts/build --peers)";
  for (const char* scene : {"terrain:10000", "sphere:10000", "pits:10000"}) {
    const Slide slide = slideOn(scene);
    const Mesh mesh = trianglesOf(*slide.shape);
    for (const PeerKind& kind : peers()) {
      const auto peer = kind.make(mesh);
      for (const Question question : peer->questions()) {
        const Agreement agreement =
            compare(expected(slide, question), timeAnswers(*peer, question, slide.probes, HUGE_VAL).metres);
        EXPECT_GT(agreement.compared, slide.probes.size() * 9 / 10) << kind.name << " on " << scene;
        EXPECT_EQ(agreement.different, 0u) << kind.name << " on " << scene;
      }
    }
  }
}

TEST(PassTimes, TheMiddleOneOfEachCountsAndAllAreKept) {
  PassTimes times;
  const std::array<std::array<std::int64_t, 2>, kPasses> passes{{{10, 9000}, {3000, 200}, {30, 100}}};
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const std::int64_t time_ns : passes[static_cast<std::size_t>(pass)]) times.add(pass, time_ns);
  }
  EXPECT_EQ(times.middle().count(), 2u);
  EXPECT_EQ(times.middle().total_ns(), 30 + 200);
  EXPECT_EQ(times.all().count(), 6u);
  EXPECT_EQ(times.all().max_us(), 9);
}

TEST(Interruptions, AreTheGapsBetweenReadingsOfTheClock) {
  const Interruptions found = measureInterruptions(0.05);
  EXPECT_EQ(found.seconds, 0.05);
  if (found.gaps.count() > 0) {
    EXPECT_GE(found.gaps.total_ns(), kMinGap_ns * static_cast<std::int64_t>(found.gaps.count()));
  }
}

TEST(Suite, GrowthOfOneSizeIsNotPrintedAndRowsCountEveryTick) {
  SuitePlan plan;
  BenchScene scene;
  scene.name = "plane";
  scene.sizes = {200};
  scene.make = [](std::size_t size) { return makeBuiltinScene("plane:" + std::to_string(size)); };
  plan.scenes = {scene};
  plan.motions = {kFingerMotions.begin(), kFingerMotions.end()};
  plan.radii = {kRadiusModes.begin(), kRadiusModes.end()};
  plan.ticks = 200;
  std::size_t rows = 0, growths = 0;
  const auto ignore = [](const std::string&) {};
  const auto count = [&](const Row& row) {
    ++rows;
    EXPECT_EQ(row.times.count(), plan.ticks);
    EXPECT_EQ(row.single.count(), kPasses * plan.ticks);
    EXPECT_EQ(row.capped, 0u);
    EXPECT_GT(row.cost.all_bytes, row.cost.index_bytes);
    EXPECT_DOUBLE_EQ(row.radius_m, row.radius == "fixed" ? plan.radius_m : plan.radius_edges * row.mean_edge_m);
  };
  runSuite(plan, {count, [&](const Growth&) { ++growths; }, ignore, ignore});
  EXPECT_EQ(rows, kFingerMotions.size() * kRadiusModes.size());
  EXPECT_EQ(growths, 0u);
}

}  // namespace
}  // namespace hl::bench::test_peer
