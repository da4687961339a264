// The watchdog line search: a step that may be worse for a while is kept when it has paid off, else undone.
#include "proxy/trial.h"

#include <gtest/gtest.h>

namespace hl::test_trial {
namespace {

const Vec3 kFinger(0, 0, 0), kFrom(0, 0, 1), kNearer(0, 0, 0.9), kFarther(0, 0, 1.1);

constexpr double kLongStep_m = 1;

TEST(Trial, OneThatPaysOffIsKept) {
  Trial trial;
  trial.begin(kFrom);
  EXPECT_TRUE(trial.open());
  trial.descended();
  Vec3 position = kNearer;
  EXPECT_FALSE(trial.judge(Goal(kFinger), kLongStep_m, false, position));
  EXPECT_EQ(position, kNearer);
  EXPECT_FALSE(trial.open());
  EXPECT_EQ(trial.boldness(), 1);
}

TEST(Trial, StepsAreLessBoldAfterAFailureAndBolderAgainAfterEachThatPaysOff) {
  Trial trial;
  trial.begin(kFrom);
  Vec3 position = kFarther;
  trial.conclude(Goal(kFinger), position);
  const double after_failure = trial.boldness();
  EXPECT_LT(after_failure, 1);
  double before = after_failure;
  for (int i = 0; i < 20; ++i) {
    trial.begin(kFrom);
    position = kNearer;
    trial.conclude(Goal(kFinger), position);
    EXPECT_GE(trial.boldness(), before);
    before = trial.boldness();
  }
  EXPECT_EQ(before, 1);
}

TEST(Trial, OneThatTheStepsLeftCannotMakeGoodIsUndoneAtOnce) {
  for (const double step_m : {1e-3, 1.0}) {
    Trial trial;
    trial.begin(kFrom);
    trial.descended();
    Vec3 position = kFarther;
    const bool undone = trial.judge(Goal(kFinger), step_m, false, position);
    EXPECT_EQ(undone, step_m < 0.1);
    EXPECT_EQ(position, undone ? kFrom : kFarther);
  }
}

TEST(Trial, ItMayBeWorseForSomeStepsAndThenThePositionIsWhereItBegan) {
  Trial trial;
  trial.begin(kFrom);
  Vec3 position = kFarther;
  int steps = 0;
  for (bool undone = false; !undone; ++steps) {
    ASSERT_LT(steps, 100);
    trial.descended();
    undone = trial.judge(Goal(kFinger), kLongStep_m, false, position);
  }
  EXPECT_GT(steps, 1);
  EXPECT_EQ(position, kFrom);
  EXPECT_FALSE(trial.open());
  EXPECT_LT(trial.boldness(), 1);
}

TEST(Trial, BeforeAStepHasComeDownThereIsNothingToJudge) {
  Trial trial;
  trial.begin(kFrom);
  Vec3 position = kFarther;
  EXPECT_FALSE(trial.judge(Goal(kFinger), kLongStep_m, true, position));
  EXPECT_TRUE(trial.open());
  EXPECT_EQ(position, kFarther);
}

TEST(Trial, TheLastStepAndTheEndOfTheTickDecide) {
  for (const bool by_last_step : {false, true}) {
    Trial trial;
    trial.begin(kFrom);
    Vec3 position = kFarther;
    if (by_last_step) {
      trial.descended();
      EXPECT_TRUE(trial.judge(Goal(kFinger), kLongStep_m, true, position));
    } else {
      EXPECT_TRUE(trial.conclude(Goal(kFinger), position));
    }
    EXPECT_EQ(position, kFrom);
    EXPECT_FALSE(trial.conclude(Goal(kFinger), position)) << "only once";
  }
}

int begunOf(int chances, double per_plain) {
  Trial trial;
  int begun = 0;
  for (int i = 0; i < chances; ++i) {
    if (!trial.mayBegin(per_plain)) continue;
    ++begun;
    trial.begin(kFrom);
    Vec3 position = kFarther;
    trial.conclude(Goal(kFinger), position);
  }
  return begun;
}

TEST(Trial, WhatNeverPaysOffIsTriedEverLessOften) {
  EXPECT_GT(begunOf(4000, 2), 5);
  EXPECT_LT(begunOf(4000, 2), 20);
}

TEST(Trial, AStepMuchLongerThanThePlainOneIsNeverLeftOut) { EXPECT_EQ(begunOf(100, 1e3), 100); }

TEST(Trial, WhileOneIsOpenNoOtherBegins) {
  Trial trial;
  EXPECT_TRUE(trial.mayBegin(2));
  trial.begin(kFrom);
  EXPECT_FALSE(trial.mayBegin(2));
  EXPECT_FALSE(trial.mayBegin(1e3));
}

}  // namespace
}  // namespace hl::test_trial
