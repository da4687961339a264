// What another program wants the hand to feel: closed forms, and that it ends with its time.
#include "control/hand_pull.h"

#include <gtest/gtest.h>

#include "base/latest.h"
#include "guard/realtime_guard.h"

namespace hl::test_hand_pull {
namespace {

constexpr std::int64_t kNow_ns = 1'000'000'000;

DeviceSample restingAt(const Vec3& position) {
  DeviceSample sample;
  sample.position = position;
  sample.status = DeviceStatus::kOk;
  return sample;
}

// The effects that a user asked for: a spring, a force and a drag.
Effects asked() {
  Effects effects;
  effects.spring_N_m = 100;
  effects.spring_D = Vec3(0.01, 0, 0);
  effects.constant_N = Vec3(0, 0, 1);
  effects.free_damping_Ns_m = 0.5;
  return effects;
}

HandPull pullUntil(std::int64_t force_ns, std::int64_t spring_ns) {
  HandPull pull;
  pull.force_until_ns = force_ns;
  pull.force_N = Vec3(1, 2, 3);
  pull.spring_until_ns = spring_ns;
  pull.spring_N_m = 300;
  pull.damping_Ns_m = 2;
  pull.place_D = Vec3(0, 0.02, 0);
  return pull;
}

TEST(HandPull, ItsForceAndItsSpringAddToWhatTheUserAskedFor) {
  const HandPull pull = pullUntil(kNow_ns + 1, kNow_ns + 1);
  for (const Vec3& finger : {Vec3(0, 0, 0), Vec3(0.03, -0.01, 0.02)}) {
    const Vec3 both_N = effectForce(withPull(asked(), pull, kNow_ns), restingAt(finger), Vec3::Zero(), true);
    const Vec3 own_N = effectForce(asked(), restingAt(finger), Vec3::Zero(), true);
    EXPECT_LT((both_N - (own_N + pull.force_N + 300 * (pull.place_D - finger))).norm(), 1e-12);
  }
}

TEST(HandPull, OfTwoDragsTheGreaterCounts) {
  HandPull pull = pullUntil(0, kNow_ns + 1);
  EXPECT_EQ(withPull(asked(), pull, kNow_ns).free_damping_Ns_m, 2);
  pull.damping_Ns_m = 0.1;
  EXPECT_EQ(withPull(asked(), pull, kNow_ns).free_damping_Ns_m, 0.5);
}

TEST(HandPull, EachEndsWithItsOwnTime) {
  const auto forceWith = [](const HandPull& pull) {
    return effectForce(withPull(Effects{}, pull, kNow_ns), restingAt(Vec3::Zero()), Vec3::Zero(), true);
  };
  EXPECT_EQ(forceWith(pullUntil(kNow_ns, kNow_ns)), Vec3(Vec3::Zero()));
  EXPECT_EQ(forceWith(pullUntil(kNow_ns + 1, kNow_ns)), Vec3(1, 2, 3));
  EXPECT_LT((forceWith(pullUntil(kNow_ns, kNow_ns + 1)) - Vec3(0, 6, 0)).norm(), 1e-12);
  EXPECT_EQ(forceWith(HandPull{}), Vec3(Vec3::Zero()));
}

TEST(HandPull, TheServoTakesItWithoutMemoryOrLocks) {
  Latest<HandPull> pulls{HandPull{}};
  pulls.write(pullUntil(kNow_ns + 1, kNow_ns + 1));
  const RealtimeGuard guard;
  HandPull pull;
  pulls.read(pull);
  EXPECT_EQ(withPull(asked(), pull, kNow_ns).spring_N_m, 400);
}

}  // namespace
}  // namespace hl::test_hand_pull
