// The planes of what touches the proxy, and the step that they allow.
#include "proxy/constraints.h"

#include <gtest/gtest.h>

#include "geometry/scenes.h"
#include "judge.h"

namespace hl::test_constraints {
namespace {

constexpr double kRadius = 1e-3;

std::shared_ptr<const Snapshot> floorAndWall() {
  return judge::scene(judge::triangles(
      {{Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(0, 0, 1)}, {Vec3(0.1, -1, -1), Vec3(0.1, 1, -1), Vec3(0.1, 0, 1)}}));
}

class ConstraintsTest : public testing::Test {
 protected:
  Proposal proposeAt(const Vec3& position, const Vec3& finger) {
    const TickInput input(scene_, settings_, finger);
    Constraints constraints(input);
    SweepCache cache;
    constraints.gather(position, Vec3::Zero(), cache);
    Proposal proposal;
    constraints.nearestTo(input.gap(position), proposal);
    return proposal;
  }
  std::shared_ptr<const Snapshot> snapshot_ = floorAndWall();
  SceneAt scene_{*snapshot_};
  ProxySettings settings_{};
};

TEST_F(ConstraintsTest, InTheOpenTheStepIsTheWayToTheFinger) {
  const Proposal open = proposeAt({0, 0.1, 0}, {0.05, 0.2, 0});
  EXPECT_EQ(open.step, Vec3(0.05, 0.2, 0) - Vec3(0, 0.1, 0));
  EXPECT_TRUE(open.active.empty());
  EXPECT_EQ(open.rule, Proposal::Rule::kPlain);
}

TEST_F(ConstraintsTest, OnAFloorItGoesAlongAndTheFloorHolds) {
  const Proposal along = proposeAt({0, kRadius, -0.5}, {0.01, -0.02, -0.5});
  EXPECT_NEAR(along.step.x(), 0.01, 1e-12);
  EXPECT_NEAR(along.step.y(), 0, 1e-12);
  ASSERT_EQ(along.active.size(), 1u);
  EXPECT_NEAR(along.active[0].multiplier_m, 0.02 + kRadius, 1e-9);
  EXPECT_EQ(along.active[0].normal, Vec3::UnitY());
}

TEST_F(ConstraintsTest, InACornerBothHold) {
  const Proposal corner = proposeAt({0.1 - kRadius, kRadius, -0.5}, {0.2, -0.02, -0.4});
  EXPECT_EQ(corner.active.size(), 2u);
  EXPECT_NEAR(corner.step.z(), 0.1, 1e-9);
  EXPECT_NEAR(corner.step.x(), 0, 1e-9);
}

// Each step, and each part of it, keeps above all planes and comes no farther from the finger.
TEST_F(ConstraintsTest, AStepIsFeasibleAndDescends) {
  test::Random random(7);
  int touched = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 position(0.1 - kRadius * (1 + random.below(2)), kRadius * (1 + random.below(2)), -0.5);
    const Vec3 finger = position + random.inCube(0.05);
    const TickInput input(scene_, settings_, finger);
    Constraints constraints(input);
    SweepCache cache;
    constraints.gather(position, Vec3::Zero(), cache);
    Proposal proposal;
    constraints.nearestTo(input.gap(position), proposal);
    touched += constraints.touches() ? 1 : 0;
    for (const Plane& plane : constraints.set().planes)
      EXPECT_GE(plane.normal.dot(proposal.step), plane.offset - input.tolerance.feasible);
    EXPECT_LE((finger - position - proposal.step).norm(), (finger - position).norm() + input.tolerance.skin);
  }
  EXPECT_GT(touched, 1000);
}

}  // namespace
}  // namespace hl::test_constraints
