// The watchdog line search: a step that may be worse for a while is kept when it has paid off, else undone.
#include "proxy/trial.h"

#include <gtest/gtest.h>

namespace hl {
namespace {

const Vec3 kFinger(0, 0, 0), kFrom(0, 0, 1), kNearer(0, 0, 0.9), kFarther(0, 0, 1.1);

TEST(Trial, OneThatPaysOffIsKeptAndTheNextIsBolder) {
  Trial trial;
  trial.begin(kFrom);
  EXPECT_TRUE(trial.open());
  trial.descended();
  Vec3 position = kNearer;
  EXPECT_FALSE(trial.judge(Goal(kFinger), false, position));
  EXPECT_EQ(position, kNearer);
  EXPECT_FALSE(trial.open());
  EXPECT_GT(trial.boldness(), 1);
}

TEST(Trial, ItMayBeWorseForSomeStepsAndThenThePositionIsWhereItBegan) {
  Trial trial;
  trial.begin(kFrom);
  Vec3 position = kFarther;
  int steps = 0;
  for (bool undone = false; !undone; ++steps) {
    ASSERT_LT(steps, 100);
    trial.descended();
    undone = trial.judge(Goal(kFinger), false, position);
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
  EXPECT_FALSE(trial.judge(Goal(kFinger), true, position));
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
      EXPECT_TRUE(trial.judge(Goal(kFinger), true, position));
    } else {
      EXPECT_TRUE(trial.conclude(Goal(kFinger), position));
    }
    EXPECT_EQ(position, kFrom);
    EXPECT_FALSE(trial.conclude(Goal(kFinger), position)) << "only once";
  }
}

TEST(Trial, WhatNeverPaysOffIsTriedEverLessOften) {
  constexpr int kChances = 4000;
  Trial trial;
  int begun = 0;
  for (int i = 0; i < kChances; ++i) {
    if (!trial.mayBegin()) continue;
    ++begun;
    trial.begin(kFrom);
    Vec3 position = kFarther;
    trial.conclude(Goal(kFinger), position);
  }
  EXPECT_GT(begun, 5);
  EXPECT_LT(begun, 20);
}

TEST(Trial, WhileOneIsOpenNoOtherBegins) {
  Trial trial;
  EXPECT_TRUE(trial.mayBegin());
  trial.begin(kFrom);
  EXPECT_FALSE(trial.mayBegin());
}

}  // namespace
}  // namespace hl
