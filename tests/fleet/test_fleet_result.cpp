// What is kept of a trace, against sums over its rows; and that bytes give back what they were made of.
#include "fleet/fleet_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/fields.h"
#include "io/load_scene.h"

namespace hl::test_fleet_result {
namespace {

struct Felt {
  std::vector<TraceRow> rows;
  FleetResult result;
};

// In and out of a ball, so that there are ticks with and without contact.
Felt felt(double deepest_m, bool keeps_rows = true) {
  const auto snapshot = makeSnapshot(loadScene("sphere:2000"), HierarchyKind::kBvh);
  std::vector<PathSample> path;
  for (int i = 0; i < 300; ++i) path.push_back({1e-3 * i, Vec3(0, 0, 0.2 - deepest_m * std::sin(M_PI * i / 300))});
  Felt felt;
  FleetRecorder recorder(keeps_rows);
  const TraceTotals totals = runTrace(*snapshot, {}, path, [&](const TraceRow& row) {
    felt.rows.push_back(row);
    recorder.add(row);
  });
  felt.result = recorder.take("name", totals);
  return felt;
}

TEST(FleetResults, AreSumsOverTheRows) {
  const Felt trace = felt(0.15);
  double ticks = 0, deepest = 0, depths = 0, strongest = 0, forces = 0, injected = 0;
  for (const TraceRow& row : trace.rows) {
    const double depth = (row.proxy - row.finger).norm(), force = row.force.norm();
    deepest = std::max(deepest, depth);
    strongest = std::max(strongest, force);
    if (row.contacts > 0) {
      ++ticks;
      depths += depth;
      forces += force;
    }
    injected += row.injected_J;
  }
  const FleetSummary& summary = trace.result.summary;
  ASSERT_GT(ticks, 0);
  EXPECT_EQ(summary.ticks, 300);
  EXPECT_EQ(summary.contact_ticks, ticks);
  EXPECT_EQ(summary.gap_max_m, deepest);
  EXPECT_EQ(summary.force_max_N, strongest);
  EXPECT_NEAR(summary.gap_mean_m, depths / ticks, 1e-12);
  EXPECT_NEAR(summary.force_mean_N, forces / ticks, 1e-9);
  EXPECT_NEAR(summary.injected_J - summary.dissipated_J, injected, 1e-12);
  double ended = 0;
  for (const double count : summary.ended) ended += count;
  EXPECT_EQ(ended, 300);
}

TEST(FleetResults, OfNoContactHaveNoMean) {
  const FleetSummary summary = felt(0).result.summary;
  EXPECT_EQ(summary.contact_ticks, 0);
  EXPECT_EQ(summary.gap_mean_m, 0);
  EXPECT_EQ(summary.force_mean_N, 0);
}

TEST(FleetResults, KeepTheRowsThatAreAskedFor) {
  const Felt trace = felt(0.15);
  ASSERT_EQ(trace.result.rows.size(), 300 * kFleetRowNumbers);
  const double* row = &trace.result.rows[150 * kFleetRowNumbers];
  const TraceRow& is = trace.rows[150];
  EXPECT_EQ(row[0], is.t);
  EXPECT_EQ(row[3], is.finger.z());
  EXPECT_EQ(row[6], is.proxy.z());
  EXPECT_EQ(row[9], is.target.z());
  EXPECT_EQ(row[12], is.force.z());
  EXPECT_EQ(row[13], is.contacts);
  EXPECT_EQ(row[14], is.iterations);
  EXPECT_EQ(row[15], is.injected_J);
  const Felt without = felt(0.15, false);
  EXPECT_TRUE(without.result.rows.empty());
  EXPECT_EQ(without.result.rows_sha256, trace.result.rows_sha256);
}

TEST(FleetResults, HaveAHashOfEveryRow) {
  EXPECT_EQ(felt(0.15).result.rows_sha256, felt(0.15).result.rows_sha256);
  EXPECT_NE(felt(0.15).result.rows_sha256, felt(0.15000000000000002).result.rows_sha256);
}

TEST(FleetResults, ComeBackFromTheirBytes) {
  FleetResult result = felt(0.15).result;
  const std::string bytes = bytesOf(result);
  std::optional<FleetResult> back = fleetResultOf(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, "name");
  EXPECT_EQ(back->rows, result.rows);
  EXPECT_EQ(back->rows_sha256, result.rows_sha256);
  EXPECT_EQ(back->summary.force_max_N, result.summary.force_max_N);
  EXPECT_EQ(bytesOf(*back), bytes);
  EXPECT_FALSE(fleetResultOf(bytes.substr(0, bytes.size() / 2)));
  EXPECT_FALSE(fleetResultOf("no result"));
}

TEST(FleetColumns, AreOneForEachNumber) {
  FleetSummary summary;
  std::size_t numbers = 0;
  auto count = [&](double&) { ++numbers; };
  visitFields(summary, count);
  std::set<std::string> names;
  for (const FleetColumn& column : fleetColumns()) names.insert(column.name);
  EXPECT_EQ(names.size(), numbers);
  EXPECT_EQ(fleetColumns().size(), numbers);
}

}  // namespace
}  // namespace hl::test_fleet_result
