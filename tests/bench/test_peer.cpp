// What hl bench asks, of HL and of the libraries that it was built with: the answers are distances, and agree.
#include <gtest/gtest.h>

#include <cmath>

#include "builtin.h"
#include "tick/own_queries.h"
#include "tick/peers/peers.h"
#include "tick/suite.h"

namespace hl::bench {
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

TEST(Peer, OwnQueriesOnAPlaneAreItsDistances) {
  const Slide slide = slideOn("plane:200");
  const auto near = makeOwnQuery(*slide.snapshot, Question::kNear);
  const auto impact = makeOwnQuery(*slide.snapshot, Question::kImpact);
  for (const Probe& probe : slide.probes) {
    ASSERT_NEAR(near->ask(probe), kRadius_m, 1e-9);
    const double fall = (probe.from.y() - kRadius_m) / -probe.motion.y();
    ASSERT_NEAR(impact->ask(probe), fall * probe.motion.norm(), 1e-9);
  }
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
      const auto own = makeOwnQuery(*slide.snapshot, peer->question());
      const Agreement agreement =
          compare(timeAnswers(*own, slide.probes, HUGE_VAL).metres, timeAnswers(*peer, slide.probes, HUGE_VAL).metres);
      EXPECT_GT(agreement.compared, slide.probes.size() * 9 / 10) << kind.name << " on " << scene;
      EXPECT_EQ(agreement.different, 0u) << kind.name << " on " << scene;
    }
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
    EXPECT_EQ(row.capped, 0u);
    EXPECT_GT(row.cost.all_bytes, row.cost.index_bytes);
    EXPECT_DOUBLE_EQ(row.radius_m, row.radius == "fixed" ? plan.radius_m : plan.radius_edges * row.mean_edge_m);
  };
  runSuite(plan, {count, [&](const Growth&) { ++growths; }, ignore, ignore});
  EXPECT_EQ(rows, kFingerMotions.size() * kRadiusModes.size());
  EXPECT_EQ(growths, 0u);
}

}  // namespace
}  // namespace hl::bench
