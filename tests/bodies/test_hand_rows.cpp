// The rows of hands have room of their own: however much the hands may meet, what holds them and what bears the bodies
// has its rows.
#include "bodies/hand_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies/test_worlds.h"
#include "guard/realtime_guard.h"

namespace hl::test_hand_rows {
namespace {

constexpr double kAround_m = 0.02, kBall_m = 0.002;

// As many balls as a body may have parts, spread over a sphere about its centre; one is the lowest.
Compound shell() {
  const double golden_rad = M_PI * (3 - std::sqrt(5.0));
  std::vector<Convex> balls;
  for (std::size_t i = 0; i < kMaxParts; ++i) {
    const double y = -1 + 2 * static_cast<double>(i) / (kMaxParts - 1), out = std::sqrt(std::max(0.0, 1 - y * y));
    const double angle = golden_rad * static_cast<double>(i);
    const Vec3 place = kAround_m * Vec3(out * std::cos(angle), y, out * std::sin(angle));
    balls.push_back(withMiddle(moved(ballShape(kBall_m), place), place));
  }
  return Compound(std::move(balls));
}

// Within the shell, held by it on all sides and pulled down with so much that the proxy may meet each of its balls.
HandNode hand() {
  HandNode node;
  node.radius_m = 0.001;
  node.stretch = Vec3(0, kAround_m, 0);
  for (std::size_t i = 0; i < kContactsOfHand; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / kContactsOfHand;
    node.contacts.push({1, node.proxy, Vec3(std::cos(angle), 0, std::sin(angle)), 0.5, 0.5, false});
  }
  return node;
}

std::ptrdiff_t rowsOf(const BodyStepper& stepper, int node) {
  return std::count_if(stepper.rows().begin(), stepper.rows().end(), [&](const Row& row) { return row.a == node; });
}

TEST(HandRows, AllHandsAtABodyOfManyPartsHaveRoomAndLeaveTheBodyItsOwn) {
  World world;
  world.bodies.push_back({1, massOfBall(1, kAround_m), shell(), {0.5, 0.5, 0}});
  world.fixed = test::floorScene();
  world.gravity_m_s2 = Vec3::Zero();
  test::Playground play(std::move(world), {test::placeAt(Vec3(0, kAround_m + kBall_m, 0))});
  std::vector<HandNode> hands(kMaxHands, hand());
  for (HandNode& one : hands) {
    one.proxy = Vec3(0, kAround_m + kBall_m, 0);
    for (HandContact& contact : one.contacts) contact.point = one.proxy;
  }
  BodyStepReport report;
  {
    const RealtimeGuard guard;
    report = play.step(hands);
  }
  for (int number = 1; number <= static_cast<int>(kMaxHands); ++number)
    EXPECT_EQ(rowsOf(play.stepper, number), static_cast<std::ptrdiff_t>(kContactsOfHand + kNearOfHand)) << number;
  EXPECT_GE(rowsOf(play.stepper, 0), 1) << "nothing bears the body";
  EXPECT_GT(report.dropped, 0U);
  EXPECT_LT(play.state.bodies[0].velocity.norm(), 1e-3);
}

}  // namespace
}  // namespace hl::test_hand_rows
