// When the steps of a tick have come to an end other than by a step of no length.
#include "proxy/progress.h"

#include <gtest/gtest.h>

#include "judge.h"
#include "proxy/tolerances.h"

namespace hl::test_progress {
namespace {

const Goal kGoal(Vec3::Zero());

TEST(Progress, StepsThatComeNoNearerIdleAfterSome) {
  Progress progress;
  EXPECT_FALSE(progress.idleAt(Vec3(0, 0, 1), kGoal));
  for (int i = 1; i < 20; ++i) EXPECT_EQ(progress.idleAt(Vec3(0, 0, i % 2 == 0 ? 1 : 1.1), kGoal), i >= 8) << i;
}

TEST(Progress, OneThatComesNearerBeginsTheCountAnew) {
  Progress progress;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(progress.idleAt(Vec3(0, 0, i % 7 == 0 ? 1 - 1e-3 * i : 2), kGoal));
}

TEST(Progress, AnotherGoalBeginsTheCountAnew) {
  Progress progress;
  for (int i = 0; i < 9; ++i) progress.idleAt(Vec3(0, 0, 1), kGoal);
  progress.stall();
  EXPECT_TRUE(progress.stalled());
  progress.begin();
  EXPECT_FALSE(progress.stalled());
  EXPECT_FALSE(progress.idleAt(Vec3(0, 0, 1), kGoal));
}

// A floor of two triangles, the proxy on one of them, on their common edge, and on the other.
class Settling : public testing::Test {
 protected:
  ContactSet contactsAt(const Vec3& centre) const {
    ContactSet set;
    gatherContacts(scene_, centre, tolerance_.touching, tolerance_.reach, set);
    return set;
  }
  static constexpr double kRadius = 1e-3;
  std::shared_ptr<const Snapshot> snapshot_ = judge::scene(judge::triangles(
      {{Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 1)}, {Vec3(-1, 0, -1), Vec3(1, 0, 1), Vec3(-1, 0, 1)}}));
  SceneAt scene_{*snapshot_};
  Tolerances tolerance_ = Tolerances::of(kRadius, scene_.extent());
  Progress progress_;
};

TEST_F(Settling, HoldsWhileTheSameFacesDo) {
  const ContactSet here = contactsAt({0.5, kRadius, 0});
  ASSERT_EQ(here.contacts.size(), 1u);
  EXPECT_FALSE(progress_.settledOn(here));
  progress_.settleOn(here);
  EXPECT_TRUE(progress_.settledOn(here));
  EXPECT_TRUE(progress_.settledOn(contactsAt({0.4, kRadius, 0.1})));
  EXPECT_FALSE(progress_.settledOn(contactsAt({-0.5, kRadius, 0}))) << "the other triangle";
  EXPECT_FALSE(progress_.settledOn(contactsAt({0.5, 2 * kRadius, 0}))) << "in the air";
  progress_.unsettle();
  EXPECT_FALSE(progress_.settledOn(here));
}

TEST_F(Settling, NothingSettlesOnEdgesWhosePlanesTurn) {
  const ContactSet beside = contactsAt({1 + 0.5 * kRadius, std::sqrt(0.75) * kRadius, 0});
  ASSERT_EQ(beside.contacts.size(), 1u);
  ASSERT_NE(beside.contacts[0].feature, Feature::kFace);
  progress_.settleOn(beside);
  EXPECT_FALSE(progress_.settledOn(beside));
}

}  // namespace
}  // namespace hl::test_progress
