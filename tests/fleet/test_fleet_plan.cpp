// Plans: which tasks there are, and that their names change with whatever a result depends on, and with nothing else.
#include "fleet/fleet_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "temp_folder.h"

namespace hl::test_fleet_plan {
namespace {

SweepFile twoByTwo() {
  test::fileWith("a.csv", "t,x,y,z\n0,0,0,0\n");
  test::fileWith("b.csv", "t,x,y,z\n0,0,0,1\n");
  test::fileWith("m.obj", "mtllib m.mtl\nv 0 0 0\n");
  test::fileWith("m.mtl", "newmtl a\n");
  SweepFile sweep;
  sweep.scenes = {"teapot", test::tempFile("m.obj")};
  sweep.paths = {test::tempFile("a.csv"), test::tempFile("b.csv")};
  sweep.options = {{{"radius", "1"}}, {{"radius", "2"}}, {}};
  sweep.seeds = {4, 5};
  return sweep;
}

std::vector<std::string> namesOf(const FleetPlan& plan) {
  std::vector<std::string> names;
  for (const FleetTask& task : plan.tasks) names.push_back(task.name);
  return names;
}

std::size_t differing(const FleetPlan& a, const FleetPlan& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.tasks.size(); ++i) count += a.tasks[i].name == b.tasks[i].name ? 0 : 1;
  return count;
}

TEST(FleetPlans, HaveATaskForEachCombination) {
  const FleetPlan plan = makeFleetPlan(twoByTwo(), "1.0");
  ASSERT_EQ(plan.tasks.size(), 2u * 2 * 3 * 2);
  const auto names = namesOf(plan);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(plan.wordsOf(plan.tasks[1]),
            (std::vector<std::string>{"teapot", "--path=" + test::tempFile("a.csv"), "--radius=1", "--seed=5"}));
  EXPECT_EQ(plan.wordsOf(plan.tasks[22]),
            (std::vector<std::string>{test::tempFile("m.obj"), "--path=" + test::tempFile("b.csv"), "--seed=4"}));
}

TEST(FleetPlans, AreTheSameForTheSameFiles) {
  const FleetPlan plan = makeFleetPlan(twoByTwo(), "1.0"), again = makeFleetPlan(twoByTwo(), "1.0");
  EXPECT_EQ(namesOf(plan), namesOf(again));
  EXPECT_EQ(plan.name, again.name);
}

TEST(FleetPlans, NameTasksByAllThatTheirResultDependsOn) {
  const SweepFile sweep = twoByTwo();
  const FleetPlan plan = makeFleetPlan(sweep, "1.0");
  EXPECT_EQ(differing(plan, makeFleetPlan(sweep, "1.1")), 24u);
  SweepFile rows = sweep;
  rows.rows = true;
  EXPECT_EQ(differing(plan, makeFleetPlan(rows, "1.0")), 24u);
  SweepFile options = sweep;
  options.options[0][0].value = "3";
  EXPECT_EQ(differing(plan, makeFleetPlan(options, "1.0")), 8u);
  SweepFile seeds = sweep;
  seeds.seeds[0] = 6;
  EXPECT_EQ(differing(plan, makeFleetPlan(seeds, "1.0")), 12u);
  test::fileWith("b.csv", "t,x,y,z\n0,0,0,2\n");
  EXPECT_EQ(differing(plan, makeFleetPlan(sweep, "1.0")), 12u);
  twoByTwo();
  test::fileWith("m.mtl", "newmtl b\n");  // named by the scene's file
  const FleetPlan changed = makeFleetPlan(sweep, "1.0");
  EXPECT_EQ(differing(plan, changed), 12u);
  EXPECT_NE(plan.name, changed.name);
}

TEST(FleetPlans, NameTasksByContentAndNotByPlace) {
  SweepFile sweep = twoByTwo();
  const FleetPlan plan = makeFleetPlan(sweep, "1.0");
  std::filesystem::create_directory(test::tempFile("elsewhere"));
  for (const char* name : {"m.obj", "m.mtl", "b.csv"})
    std::filesystem::copy(test::tempFile(name), test::tempFile("elsewhere"));
  sweep.scenes[1] = test::tempFile("elsewhere/m.obj");
  sweep.paths[1] = test::tempFile("elsewhere/b.csv");
  EXPECT_EQ(differing(plan, makeFleetPlan(sweep, "1.0")), 0u);
}

TEST(FleetPlans, NeedTheirFiles) {
  SweepFile sweep = twoByTwo();
  sweep.paths.push_back(test::tempFile("none.csv"));
  EXPECT_THROW(makeFleetPlan(sweep, "1.0"), Error);
}

}  // namespace
}  // namespace hl::test_fleet_plan
