#include "scene/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/scenes.h"

namespace hl::test_motion {
namespace {

Pose poseOf(const Vec3& turn, const Vec3& origin) {
  Pose pose;
  if (turn.norm() > 0) pose.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  pose.origin = origin;
  return pose;
}

constexpr std::int64_t kMs = 1'000'000;

TEST(Motion, RestsBeforeAndAfterToTheBit) {
  const Pose a = poseOf({0.1, 0.2, 0.3}, {1, 2, 3}), b = poseOf({-0.4, 0.2, 0}, {2, 2, 2});
  const Screw screw(a, b, 10, 20);
  EXPECT_TRUE(screw.at(10) == a);
  EXPECT_TRUE(screw.at(-5) == a);
  EXPECT_TRUE(screw.at(20) == b);
  EXPECT_TRUE(screw.at(1000) == b);
  EXPECT_TRUE(Screw(a, a, 10, 20).at(15) == a);
}

// What is hinged stays hinged: the centre of a turn does not move, whatever point of the object it is.
TEST(Motion, TheHingeOfATurnStaysInPlace) {
  for (const double angle : {1e-9, 1e-5, 0.009, 0.011, 0.5, 3.0}) {
    const Vec3 hinge(0.3, -0.2, 0.5);
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const Pose from = poseOf({0.3, 0.1, 0}, {0.7, 0.1, 0.2});
    const Pose to{turn * from.rotation, hinge + turn * (from.origin - hinge)};
    const Screw screw(from, to, 0, kMs);
    const Vec3 hinge_O = from.toObject(hinge);
    for (std::int64_t t = 0; t <= kMs; t += kMs / 16) EXPECT_LT((screw.at(t).toWorld(hinge_O) - hinge).norm(), 1e-9);
  }
}

TEST(Motion, IsContinuousAndRigidAndEndsWhereItShould) {
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Pose from = poseOf(random.inCube(1.5), random.inCube(1)), to = poseOf(random.inCube(1.5), random.inCube(1));
    const Screw screw(from, to, 0, kMs);
    const Pose last = screw.at(kMs - 1);
    EXPECT_LT((last.rotation - to.rotation).norm(), 1e-5);
    EXPECT_LT((last.origin - to.origin).norm(), 1e-5);
    const Pose middle = screw.at(kMs / 3);
    EXPECT_LT((middle.rotation * middle.rotation.transpose() - Mat3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(middle.rotation.determinant(), 1, 1e-12);
  }
}

TEST(Motion, ANewOneFollowsTheOldOneUntilItBegins) {
  const Motion rest(poseOf({0, 0, 0.1}, {0.1, 0, 0}));
  EXPECT_FALSE(rest.moves());
  const Motion first = rest.then(poseOf({0, 0, 0.5}, {0.2, 0, 0}), 0, 10 * kMs);
  const Motion second = first.then(poseOf({0, 0.5, 0}, {0.3, 0, 0}), 6 * kMs, 16 * kMs);
  for (std::int64_t t = 0; t <= 6 * kMs; t += kMs) EXPECT_TRUE(second.at(t) == first.at(t)) << t;
  EXPECT_LT((second.at(6 * kMs + 1).origin - first.at(6 * kMs).origin).norm(), 1e-6);
  EXPECT_TRUE(second.at(16 * kMs) == second.to());
}

TEST(Motion, OnlyRestAtTheWorldIsIdentity) {
  EXPECT_TRUE(Motion().identity());
  EXPECT_FALSE(Motion(poseOf({}, {1e-9, 0, 0})).identity());
  EXPECT_FALSE(Motion().then(poseOf({}, {1, 0, 0}), 0, 10).identity());
  EXPECT_TRUE(Motion().then(Pose{}, 0, 10).identity());
}

}  // namespace
}  // namespace hl::test_motion
