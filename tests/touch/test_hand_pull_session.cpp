// A session whose hand another program pulls: it is felt within the limits, and ends with its time.
#include <gtest/gtest.h>

#include "base/clock.h"
#include "touch/session_views.h"
#include "touch/touch_session.h"
#include "wait_for.h"

namespace hl::test_hand_pull_session {
namespace {

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

TouchSettings quietHand() {
  TouchSettings settings;
  settings.explore = false;
  return settings;
}

// A busy machine may hold the servo up, which is a fault: then a person arms again.
Vec3 forceOf(TouchSession& session) {
  const ServoView servo = test::servoOf(session);
  if (servo.safety == SafetyState::kFault) session.live().rearm();
  return servo.force_N;
}

void waitUntilOn(TouchSession& session) {
  test::waitFor([&] {
    forceOf(session);
    return test::servoOf(session).safety == SafetyState::kOn;
  });
}

std::shared_ptr<const Snapshot> nothing() { return makeSnapshot(std::vector<Instance>{}, "nothing"); }

HandPull forceFor(const Vec3& force_N, std::int64_t time_ns) {
  HandPull pull;
  pull.force_N = force_N;
  pull.force_until_ns = monotonicNow_ns() + time_ns;
  return pull;
}

TEST(HandPullSession, AForceIsFeltAndTakesTheHandAlong) {
  TouchSession session(nothing(), quietHand());
  session.start();
  waitUntilOn(session);
  const double before_m = test::servoOf(session).finger_D.x();
  session.pull(forceFor(Vec3(1.5, 0, 0), kHour_ns));
  test::waitFor([&] { return (forceOf(session) - Vec3(1.5, 0, 0)).norm() < 1e-9; });
  test::waitFor([&] { return forceOf(session).x() > 0 && test::servoOf(session).finger_D.x() > before_m + 1e-3; });
}

TEST(HandPullSession, NobodyNeedsToEndIt) {
  TouchSession session(nothing(), quietHand());
  session.start();
  // Such a short one may be over before the servo has seen it, on a busy machine.
  test::waitFor([&] {
    session.pull(forceFor(Vec3(1.5, 0, 0), 50'000'000));
    return forceOf(session).x() > 0;
  });
  test::waitFor([&] { return forceOf(session).isZero(0); });
}

TEST(HandPullSession, ASpringHoldsTheHandAtItsPlace) {
  TouchSession session(nothing(), quietHand());
  session.start();
  waitUntilOn(session);
  const Vec3 place_D = test::servoOf(session).finger_D + Vec3(0.01, 0, 0);
  HandPull pull;
  pull.spring_until_ns = monotonicNow_ns() + kHour_ns;
  pull.spring_N_m = 500;
  pull.damping_Ns_m = session.deviceInfo().damping_Ns_m;
  pull.place_D = place_D;
  session.pull(pull);
  // At rest the spring's force is what the hand resists with: less far from the place than without it.
  test::waitFor([&] { return forceOf(session).x() > 0 && (test::servoOf(session).finger_D - place_D).norm() < 0.009; });
}

TEST(HandPullSession, AForceBeyondTheDeviceIsCutToItsLimit) {
  TouchSession session(nothing(), quietHand());
  session.start();
  session.pull(forceFor(Vec3(0, 1e6, 0), kHour_ns));
  const double most_N = session.deviceInfo().force_max_N;
  double strongest_N = 0;
  test::waitFor([&] {
    strongest_N = std::max(strongest_N, forceOf(session).norm());
    return strongest_N > 0.9 * most_N;
  });
  EXPECT_LE(strongest_N, most_N * (1 + 1e-9));
}

}  // namespace
}  // namespace hl::test_hand_pull_session
