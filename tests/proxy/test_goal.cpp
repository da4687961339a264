// What a tick goes toward, and which of two places is nearer to it.
#include "proxy/goal.h"

#include <gtest/gtest.h>

namespace hl::test_goal {
namespace {

TEST(Goal, IsTheFingerUntilItIsSetElsewhere) {
  Goal goal(Vec3(1, 2, 3));
  EXPECT_TRUE(goal.isFinger());
  goal.aimAt(Vec3(1, 2, 4));
  EXPECT_FALSE(goal.isFinger());
  EXPECT_EQ(goal.place(), Vec3(1, 2, 4));
  goal.aimAt(Vec3(1, 2, 3));
  EXPECT_TRUE(goal.isFinger());
}

// 1e12 m away a millimetre is below the last bit of the distance.
TEST(Goal, TheNearerOfTwoPlacesIsReportedHoweverFarItIs) {
  const Goal far(Vec3(1e12, 0, 0));
  EXPECT_TRUE(far.nearer(Vec3(1e-3, 0, 0), Vec3::Zero()));
  EXPECT_FALSE(far.nearer(Vec3::Zero(), Vec3(1e-3, 0, 0)));
  EXPECT_FALSE(far.nearer(Vec3::Zero(), Vec3::Zero()));
}

}  // namespace
}  // namespace hl::test_goal
