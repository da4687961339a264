// Goals much farther away than the scene is large: a nearer one in the same direction does as well.
#include "proxy/far_goal.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/scenes.h"
#include "proxy/solver.h"

namespace hl::test_far_goal {
namespace {

TEST(FarGoal, ANearGoalIsLeftToTheBitAndAFarOneComesNearerInItsDirection) {
  const FarGoal far(2);
  const Vec3 near(1, -1, 1.0 / 3), beyond(3e9, -4e9, 0);
  EXPECT_EQ(far.part(near), 1);
  EXPECT_EQ(far.shortened(near), near);
  EXPECT_EQ(far.shortened_m(near), near.norm());
  EXPECT_NEAR((far.shortened(beyond) - Vec3(1.2, -1.6, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(far.part(beyond), 2 / 5e9, 1e-24);
  EXPECT_EQ(far.shortened_m(beyond), 2);
}

// The step above planes that the proxy is above, toward the nearer goal.
RC_GTEST_PROP(FarGoal, AStepTowardTheNearerGoalComesNearerToTheFarOne, (std::uint64_t seed)) {
  test::Random random(seed);
  std::vector<Plane> planes;
  for (int i = 1 + random.below(5); i > 0; --i) planes.push_back({random.direction(), -random.uniform(0, 0.5)});
  const FarGoal far(1);
  const Vec3 goal = std::pow(10, random.uniform(0, 6)) * random.direction();
  const double part = far.part(goal);
  const SolverResult step = nearestAbove(planes, far.shortened(goal), 1e-13);
  RC_PRE(step.violation <= 1e-13);
  // |g|^2 - |g - s|^2, by what lies between the two.
  const double gained = 2 * step.point.dot(goal) - step.point.squaredNorm();
  RC_ASSERT(gained >= (2 / part - 1) * step.point.squaredNorm() - 1e-9 / part);
}

// The ball has the diameter 2.
RC_GTEST_PROP(FarGoal, TheWayWithinTheBallIsWhatItsPlacesSay, (std::uint64_t seed)) {
  test::Random random(seed);
  const FarGoal far(2);
  const Vec3 from = random.uniform(0, 3) * random.direction(), way = random.uniform(0, 6) * random.direction();
  const FarGoal::Within within = far.within(from, way);
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0, radius = (from + t * way).norm();
    if (std::abs(radius - 1) < 1e-9) continue;
    RC_ASSERT((radius < 1) == (within.enter <= t && t <= within.leave));
  }
}

TEST(FarGoal, AWayOfNoLengthIsWithinTheBallOrNot) {
  const FarGoal far(2);
  const FarGoal::Within inside = far.within({0.5, 0, 0}, Vec3::Zero()), outside = far.within({2, 0, 0}, Vec3::Zero());
  EXPECT_EQ(inside.enter, 0);
  EXPECT_EQ(inside.leave, 1);
  EXPECT_LT(outside.leave, outside.enter);
}

}  // namespace
}  // namespace hl::test_far_goal
